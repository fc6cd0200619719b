// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "process_check.h"

#include <unistd.h>

#include "errors.h"

namespace hooke::python {

void refuse_fork() {
  static const pid_t first_user = getpid();
  if (getpid() == first_user) return;
  raise(ErrorClass::busy, {{"process",
                            "this process was forked from one that had used hooke, whose threads it lacks; start it "
                            "anew: multiprocessing.set_start_method(\"spawn\")"}});
}

}  // namespace hooke::python
