#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/files.h"
#include "support/scratch_folder.h"

namespace nade::test {

/// What a command line left behind.
struct Ran {
  int status = -1;
  std::string out;
  std::string err;
};

/// Tests of the built program, each in an empty folder of its own, which is also where the
/// program runs.
class CliTest : public FolderTest {
 protected:
  /// Runs a shell command line in which $NADE is the program. Nothing is a terminal.
  [[nodiscard]] Ran shell(const std::string& command) const {
    const std::string kept = folder() + ".ran";
    const std::string line = "cd '" + folder() + "' && { export NADE='" NADE_TEST_CLI "'; " +
                             command + "\n} >" + kept + ".out 2>" + kept + ".err </dev/null";
    const int raw = std::system(line.c_str());
    Ran ran{WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, read_file(kept + ".out"),
            read_file(kept + ".err")};
    std::filesystem::remove(kept + ".out");
    std::filesystem::remove(kept + ".err");
    return ran;
  }

  [[nodiscard]] Ran nade(const std::string& arguments) const {
    return shell("\"$NADE\" " + arguments);
  }

  /// A short stroke to work on, as a plain recording.
  void make_stroke(const std::string& name, const std::string& options = "--object plane") const {
    const Ran ran = nade("synth -o " + name + " --duration 0.6 " + options);
    ASSERT_EQ(ran.status, 0) << ran.err;
  }

  /// Status 1 and a single line on stderr that has `part` in it, nothing on stdout.
  static void expect_failure(const Ran& ran, const std::string& part) { expect(ran, 1, part); }

  /// The same for status 2.
  static void expect_misuse(const Ran& ran, const std::string& part) { expect(ran, 2, part); }

 private:
  static void expect(const Ran& ran, int status, const std::string& part) {
    EXPECT_EQ(ran.status, status) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_NE(ran.err.find(part), std::string::npos) << ran.err << "lacks: " << part;
  }
};

}  // namespace nade::test
