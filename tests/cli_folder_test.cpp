// A folder of two hundred recordings, ten of them broken, each in its own way: one command does the
// rest, says ten sentences, and goes on where it was interrupted.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/cli_run.h"
#include "support/files.h"

namespace {

namespace fs = std::filesystem;
using nade::test::lines_of;
using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

constexpr int kStrokes = 17;
constexpr int kDays = 11;
constexpr std::size_t kBroken = 10;
constexpr std::size_t kWhole = kStrokes * kDays + 3;  // and three that are only warned of

/// Even root may not read here what its mode forbids.
const std::string kCorrect =
    "$(test $(id -u) -ne 0 || echo setpriv --bounding-set=-dac_override,-dac_read_search) "
    "env --default-signal=INT \"$NADE\" correct in -o out --object sphere";

struct Said {
  const char* of;
  const char* sentence;
};

constexpr std::array<Said, kBroken> kErrors{{
    {"in/damaged.jsonl.gz", "expected whole gzip data, found them damaged"},
    {"in/day3/not_utf8.jsonl", "line 1: column 31: expected valid JSON"},
    {"in/day3/shut/", "expected a readable file, but: Permission denied"},
    {"in/empty.jsonl", "found nothing"},
    {"in/link.jsonl", "expected a recording, found no such file"},
    {"in/long_line.jsonl", "line 2: expected at most 16 MiB in a line, found more"},
    {"in/of_the_future.jsonl", "line 1: expected version 1 of nade-recording, found 2"},
    {"in/time_back.jsonl", "line 21: t: expected a time after"},
    {"in/unreadable.jsonl", "expected a readable file, but: Permission denied"},
    {"in/wrong_json.jsonl", "line 20: column 8: expected valid JSON"},
}};

constexpr std::array<Said, 3> kWarnings{{
    {"in/cut.jsonl", "cut off here; the line is left out"},
    {"in/cut_too.jsonl.gz", "cut off here; the line is left out"},
    {"in/millimetres.jsonl", "the positions look to be in millimetres, expected metres"},
}};

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string in_millimetres(const std::vector<std::string>& lines) {
  std::string text = lines.front() + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    auto frame = nlohmann::json::parse(lines[i]);
    for (auto& joint : frame["right"]["joints"]) {
      for (const std::size_t length : {0U, 1U, 2U, 7U})
        joint[length] = 1e3 * joint[length].get<double>();
    }
    text += frame.dump() + "\n";
  }
  return text;
}

class CliFolder : public nade::test::CliTest {
 protected:
  void SetUp() override {
    fs::create_directory(path("in"));
    for (int i = 0; i < kStrokes; ++i) {
      const std::string name = "stroke" + std::to_string(i) + ".jsonl.gz";
      const Ran ran =
          nade("synth -o " + name + " --object sphere --duration 0.5 --noise quest --seed " +
               std::to_string(i));
      ASSERT_EQ(ran.status, 0) << ran.err;
      for (int day = 0; day < kDays; ++day) {
        // A folder may well be named like a recording.
        const std::string folder =
            path("in/day" + std::to_string(day) + (day == 7 ? ".jsonl" : ""));
        fs::create_directory(folder);
        fs::copy(path(name), folder + "/" + name);
      }
    }
    ASSERT_EQ(nade("convert stroke0.jsonl.gz -o one.jsonl").status, 0);
    break_some();
  }

  /// What the ten, and those that are only warned of, are made of.
  void break_some() const {
    const std::string whole = read_file(path("one.jsonl"));
    const std::string packed = read_file(path("stroke0.jsonl.gz"));
    const std::vector<std::string> lines = lines_of(whole);
    const auto changed = [&](std::size_t line, const std::string& text) {
      std::vector<std::string> all = lines;
      all[line - 1] = text;
      return joined(all);
    };
    write_file(path("in/empty.jsonl"), "");
    write_file(path("in/damaged.jsonl.gz"), packed.substr(0, packed.size() - 8) + "not this");
    write_file(path("in/wrong_json.jsonl"), changed(20, R"({"t":1,,})"));
    write_file(path("in/day3/not_utf8.jsonl"), whole.substr(0, 30) + "\xff\xfe" + whole.substr(32));
    std::string future = lines[0];
    const std::string version = "\"version\":1";
    future.replace(future.find(version), version.size(), "\"version\":2");
    write_file(path("in/of_the_future.jsonl"), changed(1, future));
    write_file(path("in/time_back.jsonl"), changed(21, lines[4]));
    write_file(path("in/long_line.jsonl"), changed(2, std::string(17U << 20U, ' ')));
    write_file(path("in/cut.jsonl"), whole.substr(0, whole.size() / 2));
    write_file(path("in/cut_too.jsonl.gz"), packed.substr(0, packed.size() / 2));
    write_file(path("in/.hidden.jsonl"), "");
    write_file(path("in/unreadable.jsonl"), whole);
    fs::permissions(path("in/unreadable.jsonl"), fs::perms::none);
    fs::create_symlink("nowhere.jsonl", path("in/link.jsonl"));
    fs::create_directory(path("in/day3/shut"));
    write_file(path("in/day3/shut/take.jsonl"), whole);
    fs::permissions(path("in/day3/shut"), fs::perms::none);
    ASSERT_EQ(shell("mkfifo in/pipe.jsonl").status, 0);
    write_file(path("in/millimetres.jsonl"), in_millimetres(lines));
  }

  void TearDown() override { fs::permissions(path("in/day3/shut"), fs::perms::owner_all); }

  /// Names of all files in `out`, each with its bytes; without what is kept for the next run.
  [[nodiscard]] std::map<std::string, std::string> outputs(const std::string& folder) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(path(folder))) {
      if (entry.is_directory() || entry.path().filename() == "nade-done.jsonl") continue;
      found[entry.path().lexically_relative(path(folder))] = read_file(entry.path());
    }
    return found;
  }

  static std::size_t figure(const Ran& ran, const std::string& name) {
    const std::size_t at = ran.out.find(name + " ");
    return at == std::string::npos ? 9999 : std::stoul(ran.out.substr(at + name.size()));
  }

  static void expect_ten_sentences(const Ran& ran) {
    const std::vector<std::string> lines = lines_of(ran.err);
    ASSERT_GT(lines.size(), kBroken);
    EXPECT_EQ(lines.back(), "nade: 10 of 200 recordings could not be corrected");
    for (std::size_t i = 0; i < kBroken; ++i) {
      const std::string& line = lines[lines.size() - 1 - kBroken + i];
      EXPECT_TRUE(line.starts_with(std::string("nade: ") + kErrors[i].of + ": ")) << line;
      EXPECT_NE(line.find(kErrors[i].sentence), std::string::npos) << line;
    }
  }
};

/// Ends the command by `signal` once so many outputs are there; its exit status.
std::string ended_by(const std::string& signal, std::size_t after) {
  return kCorrect + " & until [ $(find out -name '*.gz' | wc -l) -ge " + std::to_string(after) +
         " ]; do sleep 0.01; done; kill -" + signal + " $!; wait $!";
}

TEST_F(CliFolder, TenBrokenOnesAreNamedAndTheRestIsDoneAlsoWhenInterrupted) {
  const Ran ran = shell(kCorrect);
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(figure(ran, "recordings"), kWhole + kBroken) << ran.out;
  EXPECT_EQ(figure(ran, "corrected"), kWhole);
  EXPECT_EQ(figure(ran, "failed"), kBroken);
  expect_ten_sentences(ran);
  for (const Said& warning : kWarnings) {
    const std::size_t at = ran.err.find(std::string("nade: ") + warning.of + ": ");
    ASSERT_NE(at, std::string::npos) << warning.of;
    EXPECT_NE(ran.err.find(warning.sentence, at), std::string::npos) << warning.of;
  }
  const auto expected = outputs("out");
  EXPECT_EQ(expected.size(), kWhole);
  EXPECT_EQ(nade("inspect out").status, 0);

  fs::remove_all(path("out"));
  fs::create_directory(path("out"));
  constexpr int kOfASignal = 128;
  EXPECT_EQ(shell(ended_by("KILL", kWhole / 3)).status, kOfASignal + 9);
  EXPECT_EQ(shell(ended_by("INT", kWhole / 3 * 2)).status, kOfASignal + 2);
  const auto midway = outputs("out");
  EXPECT_LT(midway.size(), kWhole);
  for (const auto& [name, bytes] : midway) EXPECT_EQ(bytes, expected.at(name)) << name;
  const Ran rest = shell(kCorrect);
  EXPECT_EQ(rest.status, 1);
  expect_ten_sentences(rest);
  // What had its name, but no line yet in nade-done.jsonl, is done again: one a thread and kill.
  EXPECT_GE(figure(rest, "done before"), kWhole / 2);
  EXPECT_LE(figure(rest, "corrected"), kWhole / 2);
  EXPECT_EQ(figure(rest, "corrected") + figure(rest, "done before"), kWhole);
  EXPECT_EQ(outputs("out"), expected);
}

}  // namespace
