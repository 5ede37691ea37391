// The built program as a person or a script meets it: exit statuses, messages, pipes, files.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/cli_run.h"
#include "support/meshes.h"
#include "support/sanitized.h"

namespace {

using nade::test::CliTest;
using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

const std::vector<std::string> kCommands{"correct", "measure", "synth", "convert", "inspect"};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t from = 0;
  for (std::size_t to = text.find('\n'); to != std::string::npos; to = text.find('\n', from)) {
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

class Cli : public CliTest {};

TEST_F(Cli, HelpOfEveryCommand) {
  EXPECT_EQ(nade("--help").status, 0);
  for (const std::string& command : kCommands) {
    const Ran ran = nade(command + " --help");
    EXPECT_EQ(ran.status, 0) << command;
    EXPECT_NE(ran.out.find(command), std::string::npos) << ran.out;
    EXPECT_EQ(ran.err, "");
  }
}

TEST_F(Cli, VersionNamesTheProgram) {
  const Ran ran = nade("--version");
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.out.rfind("nade ", 0), 0u) << ran.out;
}

TEST_F(Cli, MisuseIsTwo) {
  make_stroke("in.jsonl");
  for (const std::string& arguments :
       std::vector<std::string>{"", "frobnicate", "inspect", "correct in.jsonl --object plane",
                                "correct in.jsonl -o out.jsonl", "inspect in.jsonl --frobnicate",
                                "correct in.jsonl -o out.jsonl --object plane --method magic",
                                "correct in.jsonl -o out.jsonl --object plane --scale 0",
                                "correct in.jsonl -o out.jsonl --object plane --scale nan",
                                "correct in.jsonl -o out.jsonl --object plane --at 1,2",
                                "correct in.jsonl -o out.jsonl --object plane --turn 0,0,0,0",
                                "correct in.jsonl -o out.jsonl --object plane --press -1",
                                "correct in.jsonl -o out.jsonl --object sphere:-1",
                                "correct in.jsonl -o out.jsonl --object teapot",
                                "correct in.jsonl -o out.jsonl --object plane --friction 3",
                                "synth -o out.jsonl --object plane --stroke loop",
                                "synth -o out.jsonl --object plane --rate 0",
                                "synth -o out.jsonl --object plane --duration -1"}) {
    const Ran ran = nade(arguments);
    EXPECT_EQ(ran.status, 2) << "nade " << arguments << "\n" << ran.err;
    EXPECT_NE(ran.err, "") << "nade " << arguments;
    EXPECT_EQ(ran.out, "") << "nade " << arguments;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
}

TEST_F(Cli, MissingInputIsNamed) {
  make_stroke("in.jsonl");
  expect_failure(nade("correct nowhere.jsonl -o out.jsonl --object plane"), "nowhere.jsonl");
  expect_failure(nade("convert nowhere.jsonl -o out.jsonl"), "nowhere.jsonl");
  expect_failure(nade("inspect nowhere.jsonl"), "nowhere.jsonl");
  expect_failure(nade("measure nowhere.jsonl in.jsonl --object plane"), "nowhere.jsonl");
  expect_failure(nade("measure in.jsonl nowhere.jsonl --object plane"), "nowhere.jsonl");
  expect_failure(nade("correct in.jsonl -o out.jsonl --object nowhere.glb"), "nowhere.glb");
  expect_failure(nade("inspect ."), ".");
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
}

TEST_F(Cli, UnreadableContentIsNamed) {
  write_file(path("empty.jsonl"), "");
  write_file(path("words.jsonl"), "once upon a time\n");
  write_file(path("other.jsonl"), R"({"format":"something-else","version":1})"
                                  "\n");
  write_file(path("future.jsonl"), R"({"format":"nade-recording","version":99})"
                                   "\n");
  write_file(path("broken.jsonl.gz"), "\x1f\x8b\x08 and then nothing of the kind");
  for (const char* file :
       {"empty.jsonl", "words.jsonl", "other.jsonl", "future.jsonl", "broken.jsonl.gz"}) {
    const std::string name = file;
    expect_failure(nade("inspect " + name), name);
    expect_failure(nade("correct " + name + " -o out.jsonl --object plane"), name);
  }
  EXPECT_FALSE(std::filesystem::exists(path("out.jsonl")));
}

/// Frame lines that make a recording unusable, and what its error has to name.
TEST_F(Cli, BadFrameNamesItsLine) {
  make_stroke("in.jsonl");
  const std::vector<std::string> good = lines_of(read_file(path("in.jsonl")));
  ASSERT_GT(good.size(), 4u);
  auto frame = nlohmann::json::parse(good[3]);
  const auto& joints = frame["right"]["joints"];
  ASSERT_EQ(joints.size(), 26u);

  std::vector<std::string> bad{
      R"({"t":)", "[]", "nonsense", R"({"t":"now"})", good[2] /* the time before once more */,
      good[1] /* a time gone by */};
  auto short_joint = frame;
  short_joint["right"]["joints"][4].erase(7);
  bad.push_back(short_joint.dump());
  auto few_joints = frame;
  few_joints["right"]["joints"].erase(25);
  bad.push_back(few_joints.dump());
  auto words = frame;
  words["right"]["joints"][4][0] = "left of the middle";
  bad.push_back(words.dump());
  std::string infinite = frame.dump();
  infinite.replace(infinite.find("[["), 2, "[[1e999,");
  bad.push_back(infinite);
  std::string nan = frame.dump();
  nan.replace(nan.find("[["), 2, "[[NaN,");
  bad.push_back(nan);

  for (const std::string& line : bad) {
    write_file(path("bad.jsonl"),
               good[0] + "\n" + good[1] + "\n" + good[2] + "\n" + line + "\n" + good[4] + "\n");
    const Ran ran = nade("correct bad.jsonl -o out.jsonl --object plane");
    SCOPED_TRACE(line.substr(0, 60));
    expect_failure(ran, "bad.jsonl: line 4");
    EXPECT_FALSE(std::filesystem::exists(path("out.jsonl")));
  }
}

TEST_F(Cli, CutOffFileIsReadToItsLastWholeLine) {
  make_stroke("in.jsonl");
  std::string text = read_file(path("in.jsonl"));
  const auto frames = lines_of(text).size() - 1;
  text.resize(text.size() - 40);
  write_file(path("cut.jsonl"), text);
  const Ran ran = nade("correct cut.jsonl -o out.jsonl --object plane");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("cut.jsonl"), std::string::npos) << ran.err;
  EXPECT_EQ(lines_of(read_file(path("out.jsonl"))).size(), frames);
}

TEST_F(Cli, CutOffGzipIsReadAsFarAsItGoes) {
  make_stroke("in.jsonl.gz");
  const std::string bytes = read_file(path("in.jsonl.gz"));
  write_file(path("cut.jsonl.gz"), bytes.substr(0, bytes.size() / 2));
  const Ran ran = nade("convert cut.jsonl.gz -o out.jsonl");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("cut.jsonl.gz"), std::string::npos) << ran.err;
  EXPECT_GT(lines_of(read_file(path("out.jsonl"))).size(), 1u);
}

TEST_F(Cli, BadMeshIsNamed) {
  make_stroke("in.jsonl");
  write_file(path("empty.obj"), "");
  write_file(path("nan.obj"), "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_file(path("flat.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  write_file(path("range.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  write_file(path("words.glb"), "this is no mesh");
  write_file(path("cut.stl"), "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0");
  write_file(path("words.ply"), "ply\nformat ascii 1.0\nnonsense\n");
  for (const char* file :
       {"empty.obj", "nan.obj", "flat.obj", "range.off", "words.glb", "cut.stl", "words.ply"}) {
    SCOPED_TRACE(file);
    expect_failure(nade(std::string("correct in.jsonl -o out.jsonl --object ") + file), file);
  }
  EXPECT_FALSE(std::filesystem::exists(path("out.jsonl")));
}

TEST_F(Cli, UnknownJointNameIsNamed) {
  std::string text = read_file(NADE_TEST_DATA_DIR "/webxr_actions.json");
  const std::string known = "\"ring-finger-tip\"";
  const std::size_t at = text.find(known);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, known.size(), "\"sixth-finger-tip\"");
  write_file(path("six.json"), text);
  for (const char* command : {"convert six.json -o out.jsonl", "inspect six.json",
                              "correct six.json -o out.jsonl --object plane"}) {
    const Ran ran = nade(command);
    expect_failure(ran, "six.json");
    expect_failure(ran, "sixth-finger-tip");
  }
  EXPECT_EQ(files(), std::vector<std::string>{"six.json"});
}

/// As a tracker may give a hand it has lost: one finger, or all of it, in one place.
TEST_F(Cli, BonesWithoutLengthGiveFiniteHands) {
  make_stroke("in.jsonl");
  const auto lines = lines_of(read_file(path("in.jsonl")));
  for (const std::size_t from : {std::size_t{6}, std::size_t{0}}) {
    std::string text = lines[0] + "\n";
    for (std::size_t i = 1; i < lines.size(); ++i) {
      auto frame = nlohmann::json::parse(lines[i]);
      auto& joints = frame["right"]["joints"];
      const std::size_t to = from == 0 ? 26 : 11;  // of the index finger
      for (std::size_t joint = from; joint < to; ++joint) {
        for (std::size_t axis = 0; axis < 3; ++axis) joints[joint][axis] = joints[from][axis];
      }
      text += frame.dump() + "\n";
    }
    write_file(path("point.jsonl"), text);
    const Ran ran = nade("correct point.jsonl -o out.jsonl --object sphere");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const auto corrected = lines_of(read_file(path("out.jsonl")));
    ASSERT_EQ(corrected.size(), lines.size());
    for (std::size_t i = 1; i < corrected.size(); ++i) {
      const auto frame = nlohmann::json::parse(corrected[i]);  // JSON has no other numbers
      EXPECT_EQ(frame["right"]["joints"].size(), 26u);
      for (const auto& joint : frame["right"]["joints"]) {
        for (const auto& number : joint) EXPECT_TRUE(number.is_number());
      }
    }
    EXPECT_EQ(nade("measure point.jsonl out.jsonl --object sphere").status, 0);
    EXPECT_EQ(nade("inspect out.jsonl").status, 0);
  }
}

TEST_F(Cli, PressThatCannotBeNamesTheRecording) {
  make_stroke("in.jsonl");
  write_file(path("bare.jsonl"), lines_of(read_file(path("in.jsonl")))[0] + "\n");
  const std::string press = " -o out.jsonl --press 0.1 --object ";
  expect_failure(nade("correct in.jsonl" + press + "sphere:0.01"), "in.jsonl: --press 0.1");
  expect_failure(nade("correct bare.jsonl" + press + "plane"), "bare.jsonl: --press 0.1");
  expect_failure(shell("\"$NADE\" correct - " + press + "plane <bare.jsonl"),
                 "standard input: --press 0.1");
  EXPECT_EQ(files(), (std::vector<std::string>{"bare.jsonl", "in.jsonl"}));
}

TEST_F(Cli, AKilledProgramLeavesNothing) {
#if defined(O_TMPFILE)
  const int nameless = ::open(path(".").c_str(), O_WRONLY | O_TMPFILE, 0600);
  if (nameless < 0) GTEST_SKIP() << path(".") << ": no files without names here";
  ::close(nameless);
#else
  GTEST_SKIP() << "no files without names on this system";
#endif
  write_file(path("out.jsonl"), "precious");
  for (const char* signal : {"INT", "TERM", "KILL"}) {
    const Ran ran = shell(std::string("timeout --signal=") + signal +
                          " 0.4 \"$NADE\" synth --object plane --duration 86400 -o out.jsonl");
    EXPECT_GT(ran.status, 100) << signal;
    EXPECT_EQ(files(), std::vector<std::string>{"out.jsonl"}) << signal;
    EXPECT_EQ(read_file(path("out.jsonl")), "precious") << signal;
  }
}

#if !defined(NADE_SANITIZED)
void write_binary_stl(const std::string& path, const nade::TriangleSoup& soup) {
  std::ofstream file(path, std::ios::binary);
  const auto put = [&](const auto& value) {
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  file << std::string(80, ' ');
  put(static_cast<std::uint32_t>(soup.triangles.size()));
  for (const auto& triangle : soup.triangles) {
    put(std::array<float, 3>{});
    for (const std::uint32_t vertex : triangle) {
      for (const float coordinate : soup.vertices[vertex]) put(coordinate);
    }
    put(std::uint16_t{0});
  }
}

TEST_F(Cli, AMillionTrianglesAreAnObjectLikeAnother) {
  const nade::TriangleSoup ball = nade::test::uv_sphere(0.15F, 708, 708);
  ASSERT_GT(ball.triangles.size(), 1'000'000u);
  write_binary_stl(path("ball.stl"), ball);
  make_stroke("in.jsonl", "--object sphere");
  const auto start = std::chrono::steady_clock::now();
  const Ran ran = nade("correct in.jsonl -o out.jsonl --object ball.stl --at 0,-0.15,0");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  ASSERT_EQ(nade("correct in.jsonl -o exact.jsonl --object sphere").status, 0);
  const auto lines = lines_of(read_file(path("out.jsonl")));
  const auto exact = lines_of(read_file(path("exact.jsonl")));
  ASSERT_EQ(lines.size(), exact.size());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto ours = nlohmann::json::parse(lines[i])["right"];
    const auto expected = nlohmann::json::parse(exact[i])["right"];
    EXPECT_EQ(ours["status"], expected["status"]) << i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(ours["joints"][0][axis].get<double>(), expected["joints"][0][axis].get<double>(),
                  1e-4)
          << i;
    }
  }
}
#endif

TEST_F(Cli, UnwritableOutputIsNamed) {
  make_stroke("in.jsonl");
  write_file(path("file"), "");
  std::filesystem::create_directory(path("folder"));
  for (const char* out : {"nowhere/out.jsonl", "file/out.jsonl", "folder"}) {
    SCOPED_TRACE(out);
    expect_failure(nade(std::string("correct in.jsonl --object plane -o ") + out), out);
    expect_failure(nade(std::string("convert in.jsonl -o ") + out), out);
    expect_failure(nade(std::string("synth --object plane --duration 0.5 -o ") + out), out);
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"file", "folder", "in.jsonl"}));
  EXPECT_TRUE(std::filesystem::is_empty(path("folder")));
}

TEST_F(Cli, FullDiskIsAnError) {
  make_stroke("in.jsonl");
  for (const char* out : {"-o /dev/full", "-o - >/dev/full"}) {
    SCOPED_TRACE(out);
    EXPECT_EQ(nade(std::string("convert in.jsonl ") + out).status, 1);
    EXPECT_EQ(nade(std::string("correct in.jsonl --object plane ") + out).status, 1);
    EXPECT_EQ(nade(std::string("synth --object plane --duration 0.5 ") + out).status, 1);
  }
  expect_failure(nade("convert in.jsonl -o /dev/full"), "/dev/full");
  expect_failure(nade("measure in.jsonl in.jsonl --object plane --json /dev/full"), "/dev/full");
  EXPECT_EQ(nade("inspect in.jsonl >/dev/full").status, 1);
}

TEST_F(Cli, FailureKeepsWhatStoodThere) {
  make_stroke("in.jsonl");
  write_file(path("bad.jsonl"), read_file(path("in.jsonl")) + "nonsense\n{}\n");
  write_file(path("out.jsonl"), "precious");
  expect_failure(nade("correct bad.jsonl -o out.jsonl --object plane"), "bad.jsonl");
  EXPECT_EQ(read_file(path("out.jsonl")), "precious");
  EXPECT_EQ(files(), (std::vector<std::string>{"bad.jsonl", "in.jsonl", "out.jsonl"}));
}

TEST_F(Cli, PipesCarryNothingButTheRecording) {
  const Ran ran = shell(
      "\"$NADE\" synth -o - --object sphere --duration 0.6 | "
      "\"$NADE\" correct - -o - --object sphere | \"$NADE\" convert - -o -");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  const auto lines = lines_of(ran.out);
  ASSERT_GT(lines.size(), 5u);
  EXPECT_EQ(nlohmann::json::parse(lines[0])["format"], "nade-recording");
  for (const auto& line : lines) EXPECT_TRUE(nlohmann::json::accept(line)) << line;
}

TEST_F(Cli, InspectReadsStandardInput) {
  make_stroke("in.jsonl.gz");
  const Ran ran = shell("cat in.jsonl.gz | \"$NADE\" inspect -");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.out, "");
  EXPECT_EQ(ran.err, "");
}

TEST_F(Cli, GzipFollowsTheName) {
  make_stroke("in.jsonl.gz");
  EXPECT_EQ(read_file(path("in.jsonl.gz")).substr(0, 2), "\x1f\x8b");
  ASSERT_EQ(nade("convert in.jsonl.gz -o plain.jsonl").status, 0);
  ASSERT_EQ(nade("convert plain.jsonl -o again.jsonl.gz").status, 0);
  ASSERT_EQ(nade("convert again.jsonl.gz -o plain_again.jsonl").status, 0);
  EXPECT_EQ(read_file(path("plain.jsonl")), read_file(path("plain_again.jsonl")));
  EXPECT_EQ(read_file(path("plain.jsonl")).substr(0, 1), "{");
}

TEST_F(Cli, SilentWhereNothingIsATerminal) {
  EXPECT_EQ(nade("synth -o in.jsonl --object plane --duration 0.6").err, "");
  EXPECT_EQ(nade("correct in.jsonl -o out.jsonl --object plane").err, "");
  EXPECT_EQ(nade("measure in.jsonl out.jsonl --object plane").err, "");
  EXPECT_EQ(nade("convert out.jsonl -o again.jsonl").err, "");
}

TEST_F(Cli, CorrectionSaysWhatItWasMadeWith) {
  make_stroke("in.jsonl");
  ASSERT_EQ(
      nade("correct in.jsonl -o out.jsonl --object sphere:0.1 --at 0,0.01,0 --method paper").status,
      0);
  const auto lines = lines_of(read_file(path("out.jsonl")));
  EXPECT_EQ(lines.size(), lines_of(read_file(path("in.jsonl"))).size());
  const auto header = nlohmann::json::parse(lines[0]);
  EXPECT_EQ(header["method"], "paper");
  EXPECT_NE(header["object"].dump().find("sphere:0.1"), std::string::npos);
  const auto frame = nlohmann::json::parse(lines[lines.size() / 2]);
  EXPECT_EQ(frame["right"]["status"], "corrected");
}

TEST_F(Cli, ALivingObjectIsMeasuredAsItWasInEachFrame) {
  ASSERT_EQ(nade("synth -o in.jsonl --object dog:alive --place flank --duration 3").status, 0);
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object dog:alive").status, 0);
  const auto lines = lines_of(read_file(path("in.jsonl")));
  const auto header = nlohmann::json::parse(lines_of(read_file(path("out.jsonl")))[0]);
  EXPECT_EQ(header["object"], "dog:alive");
  EXPECT_EQ(header["animation_start"], 0);
  // A recording that begins later knows still when the dog began.
  std::string late = lines[0] + '\n';
  for (std::size_t i = 91; i < lines.size(); ++i) late += lines[i] + '\n';
  write_file(path("late.jsonl"), late);
  for (const std::string tracked : {"in.jsonl", "late.jsonl"}) {
    const Ran ran = nade("measure " + tracked + " out.jsonl --json -");
    ASSERT_EQ(ran.status, 0) << ran.err;
    const std::string key = "\"penetration_max_mm\": ";
    const std::size_t at = ran.out.find(key);
    ASSERT_NE(at, std::string::npos) << ran.out;
    EXPECT_LT(std::stod(ran.out.substr(at + key.size())), 1.0) << tracked;
  }
  EXPECT_EQ(nade("correct in.jsonl -o out.jsonl --object plane:alive").status, 2);
  EXPECT_EQ(nade("correct in.jsonl -o out.jsonl --object dog:alive:sleep").status, 2);
}

TEST_F(Cli, FrictionHoldsTheHandBack) {
  ASSERT_EQ(nade("synth -o in.jsonl --object plane --depth 0.02 --duration 2").status, 0);
  const auto lag_ms = [&](const std::string& friction) {
    EXPECT_EQ(nade("correct in.jsonl -o out.jsonl --object plane " + friction).status, 0);
    const Ran ran = nade("measure in.jsonl out.jsonl --json -");
    return nlohmann::json::parse(ran.out)["linkage_lag_ms"].get<double>();
  };
  const double held_ms = lag_ms("--friction 1");
  const double free_ms = lag_ms("");
  EXPECT_GT(held_ms, free_ms + 20.0);
  const auto header = nlohmann::json::parse(lines_of(read_file(path("out.jsonl")))[0]);
  EXPECT_FALSE(header.contains("friction"));
}

TEST_F(Cli, TheSameResultOnEveryRun) {
  make_stroke("a.jsonl", "--object dog --noise leap --seed 7");
  make_stroke("b.jsonl", "--object dog --noise leap --seed 7");
  EXPECT_EQ(lines_of(read_file(path("a.jsonl")))[5], lines_of(read_file(path("b.jsonl")))[5]);
  ASSERT_EQ(nade("correct a.jsonl -o c.jsonl --object dog").status, 0);
  ASSERT_EQ(nade("correct a.jsonl -o d.jsonl --object dog").status, 0);
  EXPECT_EQ(read_file(path("c.jsonl")), read_file(path("d.jsonl")));
}

TEST_F(Cli, MeasureGivesEveryMetric) {
  make_stroke("in.jsonl");
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object plane").status, 0);
  const Ran ran =
      nade("measure in.jsonl out.jsonl --object plane --json metrics.json --csv metrics.csv");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  const std::string json = read_file(path("metrics.json"));
  ASSERT_TRUE(nlohmann::json::accept(json)) << json;
  const std::string csv = read_file(path("metrics.csv"));
  for (const char* key :
       {"penetration_max_mm", "penetration_p99_mm", "penetration_mean_mm", "contact_ratio",
        "part_gap_mean_mm", "part_gap_p95_mm", "linkage_gain", "linkage_r", "linkage_lag_ms",
        "amplification_p999", "amplification_max", "pop_max_mm", "jitter_ratio",
        "bend_added_median_deg", "bend_added_p95_deg", "limit_violation_max_deg", "curl_kept"}) {
    EXPECT_NE(json.find(std::string("\"") + key + "\""), std::string::npos) << key;
    EXPECT_NE(csv.find(key), std::string::npos) << key;
  }
  const Ran piped = nade("measure in.jsonl out.jsonl --object plane --json -");
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_TRUE(nlohmann::json::accept(piped.out)) << piped.out;
}

TEST_F(Cli, HandThatComesAndGoes) {
  make_stroke("in.jsonl");
  auto lines = lines_of(read_file(path("in.jsonl")));
  ASSERT_GT(lines.size(), 20u);
  std::string text = lines[0] + "\n";
  for (std::size_t i = 1; i < lines.size(); ++i) {
    auto frame = nlohmann::json::parse(lines[i]);
    if (i % 7 < 3) frame.erase("right");
    text += frame.dump() + "\n";
  }
  write_file(path("gaps.jsonl"), text);
  const Ran ran = nade("correct gaps.jsonl -o out.jsonl --object plane");
  EXPECT_EQ(ran.status, 0) << ran.err;
  const auto corrected = lines_of(read_file(path("out.jsonl")));
  ASSERT_EQ(corrected.size(), lines.size());
  for (std::size_t i = 1; i < corrected.size(); ++i) {
    EXPECT_EQ(nlohmann::json::parse(corrected[i]).contains("right"), i % 7 >= 3) << i;
  }
  EXPECT_EQ(nade("measure gaps.jsonl out.jsonl --object plane").status, 0);
}

/// What the product is for: every frame of real recordings, on every kind of object.
TEST_F(Cli, RealClipsOnEveryObject) {
  const std::string clips = NADE_TEST_SHARED_DATA "/leap/";
  if (!std::filesystem::exists(clips)) GTEST_SKIP() << clips << ": not here";
  for (const char* clip :
       {"confidence-74fps", "HandSplay-110fps", "pinch", "rollAndPitchCropped"}) {
    if (nade::test::kSanitized && clip != std::string("pinch")) continue;
    const std::string in = "'" + clips + clip + ".json'";
    ASSERT_EQ(nade("convert " + in + " -o tracked.jsonl").status, 0) << clip;
    const std::size_t frames = lines_of(read_file(path("tracked.jsonl"))).size();
    for (const char* object : {"plane", "sphere", "dog"}) {
      SCOPED_TRACE(std::string(clip) + " on " + object);
      const Ran corrected = nade("correct " + in + " --press 0.03 -o out.jsonl --object " + object);
      ASSERT_EQ(corrected.status, 0) << corrected.err;
      const auto lines = lines_of(read_file(path("out.jsonl")));
      EXPECT_EQ(lines.size(), frames);
      EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line.find("\"corrected\"") != std::string::npos;
      }));
      const Ran measured = nade("measure " + in + " out.jsonl --json - --object " + object);
      EXPECT_EQ(measured.status, 0) << measured.err;
      EXPECT_TRUE(nlohmann::json::accept(measured.out)) << measured.out;
    }
  }
}

}  // namespace
