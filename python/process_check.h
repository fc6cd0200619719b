// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hooke::python {

/// BusyError in a process that was forked from one that had called this: it lacks the threads of the engine, for which
/// it would wait for ever, and locks may be held by threads that are not there.
void refuse_fork();

}  // namespace hooke::python
