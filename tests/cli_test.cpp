// The built program as a person or a script meets it: exit statuses, messages, pipes, files.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
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
using nade::test::lines_of;
using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

const std::vector<std::string> kCommands{"correct", "measure", "synth", "convert", "inspect"};

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

/// Of every command that was built, whichever they are.
TEST_F(Cli, HelpIsTextInEveryLetter) {
  const std::string all = nade("--help").out;
  for (const std::string command : {"correct", "render", "study run", "view", "xr"}) {
    if (all.find("\n  " + command.substr(0, command.find(' ')) + ' ') == std::string::npos)
      continue;
    const Ran ran = nade(command + " --help");
    EXPECT_EQ(ran.status, 0) << command;
    EXPECT_TRUE(std::all_of(ran.out.begin(), ran.out.end(), [](char letter) {
      return letter == '\n' || static_cast<unsigned char>(letter) >= ' ';
    })) << ran.out;
    if (command == "xr") {
      expect_misuse(nade("xr --graphics foo"), "--graphics: expected egl|xlib, found 'foo'");
    }
  }
}

TEST_F(Cli, VersionNamesTheProgram) {
  const Ran ran = nade("--version");
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.out.rfind("nade ", 0), 0u) << ran.out;
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

/// As a tracker may give a hand it has lost: one finger, or all of it, in one place.
TEST_F(Cli, BonesWithoutLengthGiveFiniteHands) {
  make_stroke("in.jsonl");
  const auto lines = lines_of(read_file(path("in.jsonl")));
  const auto in_one_point = [&](std::size_t from, std::size_t to) {
    std::string text = lines[0] + "\n";
    for (std::size_t i = 1; i < lines.size(); ++i) {
      auto frame = nlohmann::json::parse(lines[i]);
      auto& joints = frame["right"]["joints"];
      for (std::size_t joint = from; joint < to; ++joint) {
        for (std::size_t axis = 0; axis < 3; ++axis) joints[joint][axis] = joints[from][axis];
      }
      text += frame.dump() + "\n";
    }
    return text;
  };
  // The index finger; and what lies beyond the middle knuckle, with ring and little finger.
  for (const auto& [from, to] :
       std::vector<std::pair<std::size_t, std::size_t>>{{6, 11}, {13, 26}}) {
    const std::string text = in_one_point(from, to);
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
  write_file(path("point.jsonl"), in_one_point(0, 26));
  const Ran ran = nade("correct point.jsonl -o out.jsonl --object sphere");
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.err.find("the hand has no length"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("no frame has a hand"), std::string::npos) << ran.err;
  EXPECT_EQ(read_file(path("out.jsonl")).find("right\":{"), std::string::npos);
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

TEST_F(Cli, TouchingNothingIsSaid) {
  make_stroke("in.jsonl");
  Ran ran = nade("correct in.jsonl -o out.jsonl --object plane --at 0,-0.5,0");
  EXPECT_EQ(ran.status, 0);
  EXPECT_NE(ran.err.find("no hand touches plane: the nearest palm or fingertip is 4"),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("--press"), std::string::npos);
  ran = nade("correct in.jsonl -o out.jsonl --object plane --at 0,-80,0");
  EXPECT_NE(ran.err.find("different units"), std::string::npos) << ran.err;
  EXPECT_EQ(nade("correct in.jsonl -o out.jsonl --object plane --method none").err, "");
}

TEST_F(Cli, SoftnessIsInMetresAndWasInMillimetres) {
  make_stroke("in.jsonl");
  for (const char* softness : {"0.005", "5mm", "5"}) {
    ASSERT_EQ(
        nade(std::string("correct in.jsonl -o out.jsonl --object plane --softness ") + softness)
            .status,
        0);
    const auto header = nlohmann::json::parse(lines_of(read_file(path("out.jsonl")))[0]);
    EXPECT_EQ(header["softness"], 0.005) << softness;
  }
}

/// A program that is killed leaves nothing behind.
TEST_F(Cli, AKeptInputHasNoName) {
  make_stroke("in.jsonl");
  const Ran ran = shell(
      "mkdir tmp; (cat in.jsonl; sleep 1) | "
      "TMPDIR=$PWD/tmp \"$NADE\" correct - -o out.jsonl --object plane --press 0.01 & "
      "sleep 0.5; ls -A tmp; wait");
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(files(), (std::vector<std::string>{"in.jsonl", "out.jsonl", "tmp"}));
}

TEST_F(Cli, TheMeshOfARecordingIsFoundBesideIt) {
  make_stroke("in.jsonl");
  ASSERT_EQ(shell("mkdir a b; printf 'v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n' "
                  ">a/sheet.obj")
                .status,
            0);
  ASSERT_EQ(nade("correct in.jsonl -o a/out.jsonl --object a/sheet.obj").status, 0);
  const auto header = nlohmann::json::parse(lines_of(read_file(path("a/out.jsonl")))[0]);
  EXPECT_EQ(header["object"], "sheet.obj");
  EXPECT_EQ(nade("measure in.jsonl a/out.jsonl").status, 0);
  ASSERT_EQ(shell("mv a/out.jsonl b").status, 0);
  expect_failure(nade("measure in.jsonl b/out.jsonl"), "--object says where it is");
  EXPECT_EQ(nade("measure in.jsonl b/out.jsonl --object a/sheet.obj").status, 0);
}

TEST_F(Cli, InspectReadsStandardInput) {
  make_stroke("in.jsonl.gz");
  const Ran ran = shell("cat in.jsonl.gz | \"$NADE\" inspect -");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.out, "");
  EXPECT_EQ(ran.err, "");
}

TEST_F(Cli, InspectListsWhatIsInAMesh) {
  write_file(path("Block.OFF"),
             "OFF\n4 4 0\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const Ran ran = nade("inspect Block.OFF --json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  const nlohmann::json report = nlohmann::json::parse(ran.out);
  EXPECT_EQ(report["triangles"], 4);
  EXPECT_EQ(report["size_m"], nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_EQ(report["animations"], nlohmann::json::array());
  const Ran words = nade("inspect Block.OFF");
  EXPECT_NE(words.out.find("1 x 2 x 3 m"), std::string::npos) << words.out;
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
    const std::string key = "\"excess_max_mm\": ";
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

TEST_F(Cli, MeasureTakesThePlacingThatCorrectTook) {
  make_stroke("in.jsonl");
  for (const std::string placing :
       {"--object sphere --press 0.02", "--object dog --press 0.015",
        "--object sphere --at 0.1,0,0 --scale 2 --press 0.02", "--object plane --at 0,-0.005,0"}) {
    ASSERT_EQ(nade("correct in.jsonl -o out.jsonl " + placing).status, 0) << placing;
    const Ran by_header = nade("measure in.jsonl out.jsonl --csv -");
    const Ran by_options = nade("measure in.jsonl out.jsonl --csv - " + placing);
    EXPECT_EQ(by_options.status, 0) << by_options.err;
    EXPECT_EQ(by_options.out, by_header.out) << placing;
  }
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
