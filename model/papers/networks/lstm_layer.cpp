#include "model/papers/networks/lstm_layer.h"

#include <torch/autograd.h>

#include "model/papers/networks/lstm_cell.h"

namespace choreo {
namespace {

using torch::Tensor;
using torch::autograd::AutogradContext;
using torch::autograd::tensor_list;

Tensor TimeFirst(const Tensor& x) { return x.transpose(0, 1).contiguous(); }

// The graph node of a layer. Its own tensors have time before batch.
class LstmNode : public torch::autograd::Function<LstmNode> {
 public:
  static tensor_list forward(AutogradContext* context, const Tensor& input, const Tensor& h0,
                             const Tensor& c0, const Tensor& from_input, const Tensor& from_hidden,
                             const Tensor& input_bias, const Tensor& hidden_bias) {
    const Tensor x = TimeFirst(input);
    const int64_t time = x.size(0), batch = x.size(1), hidden = h0.size(1);
    const auto rows = static_cast<size_t>(batch), width = static_cast<size_t>(hidden);
    const Tensor gates =
        torch::addmm(input_bias + hidden_bias, x.view({time * batch, -1}), from_input.t())
            .view({time, batch, 4 * hidden});
    // The states, beginning with the one before the first step.
    const Tensor hs = torch::empty({time + 1, batch, hidden}, x.options());
    const Tensor cs = torch::empty_like(hs), squashed = torch::empty_like(hs);
    hs[0].copy_(h0);
    cs[0].copy_(c0);
    for (int64_t t = 0; t < time; ++t) {
      Tensor now = gates[t];
      now.addmm_(hs[t], from_hidden.t());
      auto* of_gates = now.data_ptr<float>();
      DoubleCellGate(of_gates, rows, width);
      now.sigmoid_();
      UpdateCell(of_gates, cs[t].data_ptr<float>(), cs[t + 1].data_ptr<float>(), rows, width);
      Tensor bent = squashed[t + 1];
      torch::tanh_out(bent, cs[t + 1]);
      EmitHidden(of_gates, bent.data_ptr<float>(), hs[t + 1].data_ptr<float>(), rows, width);
    }
    context->save_for_backward({x, gates, hs, cs, squashed, from_input, from_hidden});
    return {hs.narrow(0, 1, time).transpose(0, 1), cs[time].clone()};
  }

  static tensor_list backward(AutogradContext* context, const tensor_list& gradients) {
    const auto saved = context->get_saved_variables();
    const Tensor &x = saved[0], &gates = saved[1], &hs = saved[2], &cs = saved[3];
    const Tensor &squashed = saved[4], &from_input = saved[5], &from_hidden = saved[6];
    const int64_t time = x.size(0), batch = x.size(1), hidden = hs.size(2);
    const auto rows = static_cast<size_t>(batch), width = static_cast<size_t>(hidden);
    const Tensor of_out = gradients[0].defined() ? TimeFirst(gradients[0])
                                                 : torch::zeros({time, batch, hidden}, x.options());
    const Tensor of_cell = gradients[1].defined()
                               ? gradients[1].clone(torch::MemoryFormat::Contiguous)
                               : torch::zeros({batch, hidden}, x.options());
    const Tensor of_gates = torch::empty_like(gates);
    const Tensor of_hidden = torch::zeros({batch, hidden}, x.options());
    for (int64_t t = time - 1; t >= 0; --t) {
      Tensor sum = of_hidden;
      sum.add_(of_out[t]);
      BackThroughCell(gates[t].data_ptr<float>(), cs[t].data_ptr<float>(),
                      squashed[t + 1].data_ptr<float>(), sum.data_ptr<float>(),
                      of_cell.data_ptr<float>(), of_gates[t].data_ptr<float>(), rows, width);
      torch::mm_out(sum, of_gates[t], from_hidden);
    }
    const Tensor flat = of_gates.view({time * batch, 4 * hidden});
    const Tensor turned = flat.t();
    const Tensor bias = flat.sum(0);
    return {torch::mm(flat, from_input).view({time, batch, -1}).transpose(0, 1),
            of_hidden,
            of_cell,
            torch::mm(turned, x.view({time * batch, -1})),
            torch::mm(turned, hs.narrow(0, 0, time).reshape({time * batch, hidden})),
            bias,
            bias};
  }
};

}  // namespace

Tensor RunLstmLayer(const Tensor& x, const LstmWeights& weights, LstmState* state) {
  const tensor_list result =
      LstmNode::apply(x, state->h, state->c, weights[0], weights[1], weights[2], weights[3]);
  *state = {result[0].select(1, x.size(1) - 1), result[1]};
  return result[0];
}

}  // namespace choreo
