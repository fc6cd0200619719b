// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

// OpenVDB's library holds its usual grids, yet its headers let each source that makes one compile all that is virtual
// in it: reading, writing, printing, pruning. That is half of the time that such a source takes. Here it is declared to
// be in the library. Not so its nodes, whose small functions are meant to be inlined and are in no library; for the
// same reason not where nothing is inlined. To be included after OpenVDB's other headers.
#include <openvdb/openvdb.h>

#if OPENVDB_LIBRARY_MAJOR_VERSION_NUMBER == 10 && defined(__OPTIMIZE__)

// NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define HOOKE_TREE_IN_LIBRARY(TreeType)                              \
  extern template class openvdb::tree::Tree<TreeType::RootNodeType>; \
  extern template class openvdb::tree::RootNode<TreeType::RootNodeType::ChildNodeType>;
#define HOOKE_GRID_IN_LIBRARY(TreeType) \
  HOOKE_TREE_IN_LIBRARY(TreeType)       \
  extern template class openvdb::Grid<TreeType>;

HOOKE_GRID_IN_LIBRARY(openvdb::BoolTree)
HOOKE_GRID_IN_LIBRARY(openvdb::FloatTree)
HOOKE_GRID_IN_LIBRARY(openvdb::Int32Tree)
HOOKE_GRID_IN_LIBRARY(openvdb::MaskTree)
HOOKE_GRID_IN_LIBRARY(openvdb::Vec3STree)
HOOKE_GRID_IN_LIBRARY(openvdb::points::PointDataTree)
HOOKE_GRID_IN_LIBRARY(openvdb::tools::PointIndexTree)
HOOKE_TREE_IN_LIBRARY(openvdb::FloatTree::ValueConverter<unsigned char>::Type)

#undef HOOKE_GRID_IN_LIBRARY
#undef HOOKE_TREE_IN_LIBRARY
// NOLINTEND(cppcoreguidelines-macro-usage)

#endif
