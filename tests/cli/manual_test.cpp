// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT

// Man pages and completions, which hooke_manual makes of the program's options.

#include <gmock/gmock.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include "page.h"

namespace hooke::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Manual : public PageTest {
 protected:
  Manual() { shell("'" HOOKE_MANUAL "' manual"); }

  // The completions of a line, as bash offers them.
  std::string completed(const std::string& words, int at) const {
    write("ask.bash", "source manual/bash/hooke\nCOMP_WORDS=(" + words + ")\nCOMP_CWORD=" + std::to_string(at) +
                          "\n_hooke\necho \"${COMPREPLY[*]}\"\n");
    return shell("bash ask.bash");
  }
};

TEST_F(Manual, HasEveryOptionOfEveryCommand) {
  for (const char* command : {"run", "check", "bench", "render", "export", "info", "scenes", "schema", "help"}) {
    const std::string page =
        std::regex_replace(read(std::string("manual/man1/hooke-") + command + ".1"), std::regex(R"(\\-)"), "-");
    const std::string help = hooke_ok({"help", command});
    const std::regex option("--[a-z-]+");
    std::size_t count = 0;
    for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it, ++count) {
      EXPECT_THAT(page, HasSubstr(it->str())) << command;
    }
    EXPECT_GE(count, 1U) << command;
  }
  EXPECT_THAT(read("manual/man1/hooke-view.1"), HasSubstr("\\-\\-replay"));
  EXPECT_THAT(read("manual/man1/hooke.1"), HasSubstr("hooke\\fR\\fB\\-export"));
}

TEST_F(Manual, IsRoffWithoutWarnings) {
  if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "needs groff";
  EXPECT_EQ(shell("for page in manual/man1/*; do groff -man -Tutf8 -ww -z \"$page\" 2>&1; done"), "");
}

TEST_F(Manual, CompletesInBash) {
  EXPECT_EQ(completed("hooke re", 1), "render\n");
  EXPECT_EQ(completed("hooke render --color-", 2), "--color-by --color-range\n");
  EXPECT_EQ(completed("hooke render out --color-by s", 4), "speed\n");
  EXPECT_EQ(completed("hooke export out --as c", 4), "contacts cloths\n");
  EXPECT_EQ(completed("hooke view --he", 2), "--help --headless\n");
  EXPECT_EQ(completed("hooke help che", 2), "check\n");
  EXPECT_EQ(completed("hooke run --steps ''", 3), "\n");
  write("falling.json", "{}");
  write("falling.csv", "");
  EXPECT_EQ(completed("hooke run fall", 2), "falling.json\n");
  EXPECT_THAT(completed("hooke run falling.json -o ma", 4), HasSubstr("manual"));
}

TEST_F(Manual, CompletesInZsh) {
  if (std::system("command -v zsh > /dev/null") != 0) GTEST_SKIP() << "needs zsh";
  shell("zsh -n manual/zsh/_hooke");
  EXPECT_THAT(read("manual/zsh/_hooke"), Not(HasSubstr("::")));
}

}  // namespace
}  // namespace hooke::test
