#include "bench/bare_product.h"

#include <algorithm>
#include <dnnl.hpp>
#include <unordered_map>
#include <utility>

#include "model/engine/packed_matrix.h"

namespace choreo {

struct BareProducts::Impl {
  struct Product {
    dnnl::matmul matmul;
    LargePages pages;  // of the weights, as our own have them
    std::unordered_map<int, dnnl::memory> arguments;
  };
  dnnl::engine engine{dnnl::engine::kind::cpu, 0};
  dnnl::stream stream{engine};
  std::vector<Product> products;
};

BareProducts::BareProducts(const std::vector<Shape>& shapes, int rows)
    : impl_(std::make_unique<Impl>()) {
  using Tag = dnnl::memory::format_tag;
  constexpr auto kFloat = dnnl::memory::data_type::f32;
  for (const Shape& shape : shapes) {
    const dnnl::memory::desc a({rows, shape.depth}, kFloat, Tag::ab);
    const dnnl::memory::desc b({shape.depth, shape.columns}, kFloat, Tag::any);
    const dnnl::memory::desc c({rows, shape.columns}, kFloat, Tag::ab);
    const dnnl::matmul::primitive_desc chosen(dnnl::matmul::desc(a, b, c), impl_->engine);
    LargePages pages(chosen.weights_desc().get_size() / sizeof(float));
    float* at = pages.data();
    for (size_t i = 0; i < chosen.weights_desc().get_size() / sizeof(float); ++i) {
      at[i] = 1e-3F * static_cast<float>(i % 200);
    }
    bytes_ += static_cast<double>(sizeof(float)) * shape.depth * shape.columns;
    impl_->products.push_back(
        {dnnl::matmul(chosen),
         std::move(pages),
         {{DNNL_ARG_SRC, dnnl::memory(chosen.src_desc(), impl_->engine)},
          {DNNL_ARG_WEIGHTS, dnnl::memory(chosen.weights_desc(), impl_->engine, at)},
          {DNNL_ARG_DST, dnnl::memory(chosen.dst_desc(), impl_->engine)}}});
    auto& source = impl_->products.back().arguments.at(DNNL_ARG_SRC);
    auto* values = static_cast<float*>(source.get_data_handle());
    std::fill(values, values + static_cast<long>(rows) * shape.depth, 0.5F);
  }
}

BareProducts::~BareProducts() = default;

void BareProducts::Run() {
  for (Impl::Product& product : impl_->products) {
    product.matmul.execute(impl_->stream, product.arguments);
  }
  impl_->stream.wait();
}

}  // namespace choreo
