// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"

namespace CLI {
class App;
}

namespace hooke::cli {

/// Adds the options of how pictures are drawn; they write into `picture`, which must live as long as the command.
void add_picture_options(CLI::App& command, PictureArguments& picture);

}  // namespace hooke::cli
