#include "model/flow/window/time_embedding.h"

#include <gtest/gtest.h>

#include <vector>

namespace choreo::time_embedding_test {

TEST(CountEmbedding, FillsAnyWidthAndNoMore) {
  for (const size_t width : {1, 2, 7, 64, 171}) {
    std::vector<float> embedding(width + 1, 9);
    CountEmbedding(width).Fill(5, std::span(embedding).first(width));
    for (size_t place = 0; place < width; ++place)
      EXPECT_EQ(embedding[place], static_cast<float>(EmbedCountAt(5, place, width))) << width;
    EXPECT_EQ(embedding[width], 9) << width;
  }
}

}  // namespace choreo::time_embedding_test
