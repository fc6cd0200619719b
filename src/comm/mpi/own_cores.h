// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke {

/// The cores that this rank has for its threads, at least one: those that it may run on, shared out evenly among the
/// ranks of the same node that may run on them, too. All ranks call it together, after
/// join_ranks().
int own_cores();

/// How many ranks run on the node of this one. All ranks call it together, after join_ranks().
int ranks_on_this_node();

}  // namespace hooke
