#include "bench/bare_product.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <dnnl.hpp>
#include <unordered_map>
#include <utility>

#include "model/engine/packed/matrix.h"

namespace choreo {

struct BareProducts::Impl {
  struct Product {
    dnnl::matmul matmul;
    LargePages pages;  // of the weights, in the same pages as ours
    std::unordered_map<int, dnnl::memory> arguments;
  };
  dnnl::engine engine{dnnl::engine::kind::cpu, 0};
  dnnl::stream stream{engine};
  std::vector<Product> products;
};

BareProducts::BareProducts(const std::vector<Shape>& shapes, int most_rows, bool bf16)
    : impl_(std::make_unique<Impl>()) {
  using Tag = dnnl::memory::format_tag;
  using Type = dnnl::memory::data_type;
  const Type type = bf16 ? Type::bf16 : Type::f32;
  // One value for all weights, as one float or two bfloat16, because values don't affect speed.
  const auto value = std::bit_cast<float>(0x3c003c00U);
  for (const Shape& shape : shapes) {
    const int rows = shape.rows > 0 ? shape.rows : most_rows;
    const dnnl::memory::desc a({rows, shape.depth}, type, Tag::ab);
    const dnnl::memory::desc b({shape.depth, shape.columns}, type, Tag::any);
    const dnnl::memory::desc c({rows, shape.columns}, Type::f32, Tag::ab);
    const dnnl::matmul::primitive_desc chosen(dnnl::matmul::desc(a, b, c), impl_->engine);
    const size_t floats = (chosen.weights_desc().get_size() + sizeof(float) - 1) / sizeof(float);
    LargePages pages(floats);
    float* at = pages.data();
    std::fill(at, at + floats, value);
    const double products = 1.0 * shape.depth * shape.columns;
    bytes_ += (bf16 ? 2 : 4) * products;
    operations_ += 2 * products * rows;
    impl_->products.push_back(
        {dnnl::matmul(chosen),
         std::move(pages),
         {{DNNL_ARG_SRC, dnnl::memory(chosen.src_desc(), impl_->engine)},
          {DNNL_ARG_WEIGHTS, dnnl::memory(chosen.weights_desc(), impl_->engine, at)},
          {DNNL_ARG_DST, dnnl::memory(chosen.dst_desc(), impl_->engine)}}});
    auto& source = impl_->products.back().arguments.at(DNNL_ARG_SRC);
    auto* values = static_cast<char*>(source.get_data_handle());
    std::memset(values, 0, chosen.src_desc().get_size());
  }
}

BareProducts::~BareProducts() = default;

void BareProducts::Run() {
  for (Impl::Product& product : impl_->products) {
    product.matmul.execute(impl_->stream, product.arguments);
  }
  impl_->stream.wait();
}

void LimitBareProducts(std::string_view kernels) {
  if (kernels == "avx2") dnnl::set_max_cpu_isa(dnnl::cpu_isa::avx2);
}

}  // namespace choreo
