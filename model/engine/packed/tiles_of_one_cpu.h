// Products on AMX's tiles, in place of Multiply of kernels_of_one_cpu.cpp, which includes it inside
// its namespace: no #pragma once.

constexpr int kTileRows = 16;          // at most, of a and of sums; exactly, of b
constexpr long kTileElements = 16;     // of the depth in a tile of a or b: one row of 64 bytes
constexpr int kMaxStackedTiles = 3;    // stacked tiles of sums
constexpr int kTileA = 6, kTileB = 7;  // the ones before hold sums

// The layout that LDTILECFG reads.
struct alignas(64) TileShapes {
  unsigned char palette = 1, start_row = 0, reserved[14] = {};
  unsigned short row_bytes[16] = {};
  unsigned char rows[16] = {};
};

// "memory": the compiler must finish writes that this reads, and reload what it writes.
inline void ShapeTiles(const TileShapes& shapes) {
  asm volatile("ldtilecfg %0" ::"m"(shapes) : "memory");
}
inline void ReleaseTiles() { asm volatile("tilerelease" ::: "memory"); }
template <int kTile>
inline void LoadTile(const float* from, long stride) {
  asm volatile("tileloadd (%0,%1,1), %%tmm%c2" ::"r"(from), "r"(stride * 4), "i"(kTile) : "memory");
}
template <int kTile>
inline void StoreTile(float* to, long stride) {
  asm volatile("tilestored %%tmm%c2, (%0,%1,1)" ::"r"(to), "r"(stride * 4), "i"(kTile) : "memory");
}
// sum += a b
template <int kSum>
inline void MultiplyTiles() {
  asm volatile("tdpbf16ps %%tmm%c2, %%tmm%c1, %%tmm%c0" ::"i"(kSum), "i"(kTileA), "i"(kTileB));
}

// Calls f<0>() to f<kCount - 1>(): a tile's number is part of the instruction.
template <int kCount, typename F>
inline void ForTiles(const F& f) {
  if constexpr (kCount > 0) {
    ForTiles<kCount - 1>(f);
    f.template operator()<kCount - 1>();
  }
}

// Copies `rows` rows of `count` floats; the rest is zero.
inline void CopyTile(const float* from, long stride, long rows, long count, float* to) {
  for (long row = 0; row < kTileRows; ++row) {
    for (long i = 0; i < kTileElements; ++i) {
      to[row * kTileElements + i] = row < rows && i < count ? from[row * stride + i] : 0.0F;
    }
  }
}

// `rows` rows from `row` on in kTall tiles of `height`, and kWide tiles of columns from `panel` on.
template <int kTall, int kWide>
void TileBlock(const PackedProduct& p, long row, long rows, long height, long panel) {
  // The last tile may overlap the one before: all are read before any is written.
  const auto first = [&](int tile) {
    return row + (tile * height < rows - height ? tile * height : rows - height);
  };
  const auto column = [&](int tile) { return panel * kPanel + tile * kLanes; };
  ForTiles<kTall * kWide>([&]<int kSum>() {
    LoadTile<kSum>(p.init + first(kSum / kWide) * p.init_stride + column(kSum % kWide),
                   p.init_stride);
  });
  alignas(64) float a_end[kTileRows * kTileElements], b_end[kTileRows * kTileElements];
  for (long k = 0; k < p.depth; k += kTileElements) {
    const long left = p.depth - k;
    ForTiles<kWide>([&]<int kColumn>() {
      const float* b = p.b + ((panel + kColumn / 2) * p.depth + k) * kPanel + kColumn % 2 * kLanes;
      if (left >= kTileElements) {
        LoadTile<kTileB>(b, kPanel);
      } else {
        CopyTile(b, kPanel, left, kTileElements, b_end);
        LoadTile<kTileB>(b_end, kTileElements);
      }
      ForTiles<kTall>([&]<int kRow>() {
        if (kTall > 1 || kColumn == 0) {
          const float* a = p.a + first(kRow) * p.a_stride + k;
          if (left >= kTileElements) {
            LoadTile<kTileA>(a, p.a_stride);
          } else {
            CopyTile(a, p.a_stride, height, left, a_end);
            LoadTile<kTileA>(a_end, kTileElements);
          }
        }
        MultiplyTiles<kRow * kWide + kColumn>();
      });
    });
  }
  ForTiles<kTall * kWide>([&]<int kSum>() {
    StoreTile<kSum>(p.c + first(kSum / kWide) * p.c_stride + column(kSum % kWide), p.c_stride);
  });
}

void Multiply(const PackedProduct& p) {
  TileShapes shapes;
  constexpr long kMaxRowsAtOnce = kMaxStackedTiles * kTileRows;
  const long blocks = (p.rows + kMaxRowsAtOnce - 1) / kMaxRowsAtOnce;
  long row = 0;
  for (long left = blocks; left > 0; --left) {
    const long rows = (p.rows - row + left - 1) / left;
    const long tall = (rows + kTileRows - 1) / kTileRows, height = (rows + tall - 1) / tall;
    for (int tile = 0; tile <= kTileB; ++tile) {
      shapes.row_bytes[tile] = 64;
      shapes.rows[tile] = static_cast<unsigned char>(tile == kTileB ? kTileRows : height);
    }
    ShapeTiles(shapes);
    for (long panel = 0; panel < p.panels;) {
      // Fewer than four sums would wait for one another.
      const bool two = tall == 1 && p.panels - panel >= 2;
      two         ? TileBlock<1, 4>(p, row, rows, height, panel)
      : tall == 1 ? TileBlock<1, 2>(p, row, rows, height, panel)
      : tall == 2 ? TileBlock<2, 2>(p, row, rows, height, panel)
                  : TileBlock<3, 2>(p, row, rows, height, panel);
      panel += two ? 2 : 1;
    }
    row += rows;
  }
  if (blocks > 0) ReleaseTiles();
}
