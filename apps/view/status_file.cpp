// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

#include "status_file.h"

#include <fstream>
#include <system_error>

namespace hooke::view {

void StatusFile::write(const scene::Json& line) const {
  if (file_.empty()) return;
  std::filesystem::path beside = file_;
  beside += ".part";
  {
    std::ofstream out(beside, std::ios::binary);
    out << line.dump() << '\n';
    if (!out.flush()) return;
  }
  std::error_code ignored;
  std::filesystem::rename(beside, file_, ignored);
}

}  // namespace hooke::view
