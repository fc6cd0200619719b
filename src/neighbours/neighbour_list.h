// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

#include "hooke/base/assert.h"
#include "hooke/base/box3.h"
#include "hooke/base/huge_pages.h"
#include "hooke/neighbours/cell_list.h"
#include "hooke/neighbours/window_search.h"

namespace hooke {

/// A full neighbour list in lanes: 16 consecutive particles in memory form a slice, and row k of a slice holds the k-th
/// neighbour of each particle, one per lane (the sliced-ELLPACK layout: Kreutzer et al., "A unified sparse matrix data
/// format", SIAM J. Sci. Comput. 2014). The neighbours in each lane are in ascending order of id index, so a force pass
/// that adds row after row sums in canonical order. Short lanes end with fillers. An entry is a slot in memory times
/// the rule's stride, e.g. an address offset.
class NeighbourList {
 public:
  static constexpr std::size_t kLanes = kSliceLanes;
  static constexpr std::size_t kTile = hooke::kTile;
  static constexpr std::size_t kSlices = kTile / kLanes;  // of a tile

  static constexpr std::array<std::uint32_t, kLanes> kNoRow{};

  /// The rows of 1024 particles, which one thread builds and later walks over. kRowsAhead rows after the last one can
  /// be read; they mean nothing.
  struct Tile {
    const std::uint32_t* entries = kNoRow.data();  // rows of kLanes
    std::array<std::uint32_t, kSlices + 1> first_row{};  // slice g: rows first_row[g] to first_row[g + 1]
  };
  std::vector<Tile> tiles;

  /// The rows of slice g of tile s.
  std::span<const std::uint32_t> rows(std::size_t s, std::size_t g) const {
    HOOKE_ASSERT(s < tiles.size() && g < kSlices, s, tiles.size(), g);
    const Tile& tile = tiles[s];
    const std::uint32_t first = tile.first_row[g];
    return {tile.entries + std::size_t{first} * kLanes, (tile.first_row[g + 1] - first) * kLanes};
  }

  /// The same rows, to be changed in place.
  std::span<std::uint32_t> rows_to_edit(std::size_t s, std::size_t g) {
    const std::span<const std::uint32_t> rows = this->rows(s, g);
    return {const_cast<std::uint32_t*>(rows.data()), rows.size()};  // NOLINT: the memory is this list's own
  }

  /// Number of entries in use, padding included.
  std::size_t entry_count() const;

  /// Removes all rows; their memory is kept for new rows.
  void clear(std::size_t tile_count);

  /// Adds tiles without rows until there are `tile_count`.
  void add_empty_tiles(std::size_t tile_count) { tiles.resize(std::max(tiles.size(), tile_count)); }

  /// Takes the rows of one tile after the other, up to kSlices slices each, slice by slice, and writes them to their
  /// place, where they stay until clear(). One writer per thread.
  class Writer {
   public:
    explicit Writer(NeighbourList& list) : list_(list), to_(list.begun_block()) {}
    ~Writer() { list_.put_back(to_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    /// Room for the `rows` rows of the tile's next slice, to be written before the next call, which may move the rows
    /// of earlier slices.
    std::uint32_t* next_slice(std::size_t rows);
    /// Ends the tile; slices that were not asked for have no rows.
    Tile finish_tile();

   private:
    NeighbourList& list_;
    std::span<std::uint32_t> to_;  // room left
    std::uint32_t* tile_ = to_.data();
    std::size_t slice_ = 0;
    std::array<std::uint32_t, kSlices + 1> first_row_{};
  };

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 19U;  // entries: 2 MiB, a huge page

  std::span<std::uint32_t> new_block(std::size_t entries);
  std::span<std::uint32_t> begun_block();
  void put_back(std::span<std::uint32_t> rest);

  std::mutex mutex_;
  std::vector<LargeVector<std::uint32_t>> blocks_;
  std::size_t blocks_in_use_ = 0;
  std::vector<std::span<std::uint32_t>> begun_;
};

/// Points that are listed as neighbours only: those from `first` on in the columns of a rule, in the order of cells of
/// their own. Searches inside of `without` (m) leave them out.
struct GhostPoints {
  const CellList* cells = nullptr;  // null: there are none
  std::size_t first = 0;
  Box3d without = Box3d::none();
};

/// Rebuilds `list` for the sorted points, whose columns `rule` holds.
template <class Real>
void build_neighbour_list(const CellList& cells, const NeighbourRule<Real>& rule,
                          WindowSearchFunction<Real> search_window, NeighbourList& list,
                          const GhostPoints& ghosts = {});

}  // namespace hooke
