// What the built program says to a person's mistakes: the exit status, and one sentence that names
// what is wrong and where.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/cli_run.h"

namespace {

using nade::test::CliTest;
using nade::test::lines_of;
using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

class CliMistake : public CliTest {};

TEST_F(CliMistake, MisuseIsTwo) {
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

TEST_F(CliMistake, WhatIsNotExpectedIsNamed) {
  expect_misuse(nade(""), "nade: expected a command (correct, measure, synth, ");
  expect_misuse(nade("bogus --depth 1"), "), found 'bogus' (nade --help tells the rest)");
  expect_misuse(nade("synth -o out.jsonl one --two three"), "found 'one --two three'");
  expect_misuse(nade("correct in.jsonl --ouput out.jsonl --object plane"), "--ouput");
  expect_misuse(nade("convert in.jsonl"), "--output is required (nade convert --help ");
}

TEST_F(CliMistake, NumbersThatCannotBeAreNamed) {
  make_stroke("in.jsonl");
  const std::string correct = "correct in.jsonl -o out.jsonl --object plane ";
  for (const char* option : {"--softness", "--friction", "--press", "--release",
                             "--full-turn-depth", "--max-ray-turn", "--scale"}) {
    expect_misuse(nade(correct + option + " nan"), option + std::string(": expected "));
  }
  expect_misuse(nade(correct + "--softness 21"),
                "--softness: expected metres from 0 to 0.02, found '21'");
  for (const char* option :
       {"--speed", "--depth", "--tilt", "--duration", "--rate", "--hand-scale"}) {
    expect_misuse(nade(std::string("synth -o out.jsonl --object plane ") + option + " nan"),
                  option);
  }
  for (const std::string seed : {"-1", "1.5", "99999999999999999999", "0x10"}) {
    expect_misuse(nade("synth -o out.jsonl --object plane --seed " + seed),
                  "--seed: expected a whole number, found '" + seed + "'");
  }
  expect_misuse(nade("bench --jobs 0"), "--jobs: expected a whole number from 1 to 256");
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
}

TEST_F(CliMistake, AnEmptyWordIsNoValue) {
  make_stroke("in.jsonl");
  for (const std::string& arguments : std::vector<std::string>{
           "correct '' -o out.jsonl --object plane", "correct in.jsonl -o '' --object plane",
           "correct in.jsonl -o out.jsonl --object ''", "measure in.jsonl in.jsonl --json ''",
           "correct in.jsonl -o out.jsonl --object plane --press ''",
           "synth -o out.jsonl --object plane --depth ''",
           "synth -o out.jsonl --object plane --place ''",
           "synth -o out.jsonl --object plane --seed ''"}) {
    SCOPED_TRACE(arguments);
    expect_misuse(nade(arguments), "expected a");
    EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
  }
}

TEST_F(CliMistake, AnOptionOfAnotherMethodIsRefused) {
  make_stroke("in.jsonl");
  const std::string correct = "correct in.jsonl -o out.jsonl --object plane ";
  for (const char* options :
       {"--hits any", "--release 0.1 --method none", "--skin mesh --method nade",
        "--paper-literal --method nade", "--paper-literal --method none"}) {
    expect_misuse(nade(correct + options), ": only with --method paper");
  }
  for (const char* options : {"--softness 5 --method paper", "--friction 1 --method none",
                              "--softness 5 --paper-literal"}) {
    expect_misuse(nade(correct + options), ": only with --method nade");
  }
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
  for (const char* options : {"--hits any --method paper", "--paper-literal --method paper",
                              "--paper-literal", "--softness 5 --friction 1"}) {
    EXPECT_EQ(nade(correct + options).status, 0) << options;
  }
}

TEST_F(CliMistake, ACorrectedRecordingIsNotATrackedOne) {
  make_stroke("in.jsonl");
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object plane").status, 0);
  expect_failure(nade("measure out.jsonl in.jsonl --object plane"),
                 "out.jsonl: expected the tracked recording first, found a corrected one");
  expect_failure(nade("correct out.jsonl -o again.jsonl --object plane"),
                 "out.jsonl: expected a tracked recording, found a corrected one");
  EXPECT_EQ(files(), (std::vector<std::string>{"in.jsonl", "out.jsonl"}));
  EXPECT_EQ(nade("measure in.jsonl in.jsonl --object plane").status, 0);
}

TEST_F(CliMistake, APipeIsReadAsAFileIs) {
  make_stroke("in.jsonl");
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object plane --press 0.02").status, 0);
  ASSERT_EQ(shell("mkfifo fifo").status, 0);
  const std::string timed = "(cat in.jsonl >fifo &) ; timeout 20 \"$NADE\" ";
  const Ran pressed = shell(timed + "correct fifo -o piped.jsonl --object plane --press 0.02");
  EXPECT_EQ(pressed.status, 0) << pressed.err;
  EXPECT_EQ(read_file(path("piped.jsonl")), read_file(path("out.jsonl")));
  const Ran measured = shell(timed + "measure fifo out.jsonl --csv - --press 0.02");
  EXPECT_EQ(measured.status, 0) << measured.err;
  const Ran cut = shell(
      "head -c 9000 in.jsonl | \"$NADE\" correct /dev/stdin -o cut.jsonl "
      "--object plane --press 0.02");
  EXPECT_EQ(cut.err.rfind("nade: /dev/stdin: line ", 0), 0U) << cut.err;
  const std::string nonsense = "(echo nonsense >fifo &) ; timeout 20 \"$NADE\" ";
  expect_failure(shell(nonsense + "correct fifo -o no.jsonl --object plane --press 0.02"), "fifo:");
  expect_failure(shell(nonsense + "measure in.jsonl fifo --object plane"), "fifo:");
}

TEST_F(CliMistake, NoOutputIsWrittenOverWhatIsNeeded) {
  make_stroke("in.jsonl");
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object plane").status, 0);
  write_file(path("tri.obj"), "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n");
  ASSERT_EQ(shell("ln -s in.jsonl link && mkdir sub").status, 0);
  const std::vector<std::string> before = files();
  const std::string tracked = read_file(path("in.jsonl"));
  const std::string corrected = read_file(path("out.jsonl"));
  for (const std::string& arguments : std::vector<std::string>{
           "correct in.jsonl -o in.jsonl --object plane",
           "correct in.jsonl -o ./link --object plane",
           "correct in.jsonl -o new.jsonl --json sub/../new.jsonl --object plane",
           "correct in.jsonl -o out.jsonl --json in.jsonl --object plane",
           "correct in.jsonl -o tri.obj --object tri.obj", "synth -o tri.obj --object tri.obj",
           "measure in.jsonl out.jsonl --json in.jsonl",
           "measure in.jsonl out.jsonl --csv out.jsonl",
           "measure in.jsonl out.jsonl --json m.json --csv m.json",
           "bench --quick --csv b.txt --markdown b.txt",
           "bench --quick --mesh tri.obj --json tri.obj"}) {
    SCOPED_TRACE(arguments);
    expect_misuse(nade(arguments), ": expected another file than that of ");
  }
  expect_misuse(nade("bench --json - --csv -"), "--json and --csv cannot both be standard output");
  EXPECT_EQ(files(), before);
  EXPECT_EQ(read_file(path("in.jsonl")), tracked);
  EXPECT_EQ(read_file(path("out.jsonl")), corrected);
  EXPECT_EQ(nade("measure in.jsonl out.jsonl --json /dev/null --csv /dev/null").status, 0);
  EXPECT_EQ(nade("convert in.jsonl -o in.jsonl").status, 0);
}

TEST_F(CliMistake, MissingInputIsNamed) {
  make_stroke("in.jsonl");
  expect_failure(nade("correct nowhere.jsonl -o out.jsonl --object plane"), "nowhere.jsonl");
  expect_failure(nade("convert nowhere.jsonl -o out.jsonl"), "nowhere.jsonl");
  expect_failure(nade("inspect nowhere.jsonl"), "nowhere.jsonl");
  expect_failure(nade("measure nowhere.jsonl in.jsonl --object plane"), "nowhere.jsonl");
  expect_failure(nade("measure in.jsonl nowhere.jsonl --object plane"), "nowhere.jsonl");
  expect_failure(nade("correct in.jsonl -o out.jsonl --object nowhere.glb"), "nowhere.glb");
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
}

TEST_F(CliMistake, UnreadableContentIsNamed) {
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
TEST_F(CliMistake, BadFrameNamesItsLine) {
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

TEST_F(CliMistake, BadMeshIsNamed) {
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

TEST_F(CliMistake, AMeshInMillimetresIsToldSo) {
  make_stroke("in.jsonl");
  write_file(path("block.obj"),
             "v 0 0 0\nv 200 0 0\nv 0 150 0\nv 0 0 100\n"
             "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Ran large = nade("correct in.jsonl -o out.jsonl --object block.obj");
  EXPECT_EQ(large.status, 0) << large.err;
  EXPECT_EQ(lines_of(large.err).at(0),
            "nade: block.obj: 269 m large; --scale 0.001 if its file is in millimetres, 0.01 if in "
            "centimetres");
  EXPECT_EQ(nade("correct in.jsonl -o out.jsonl --object block.obj --scale 0.001").err, "");
}

/// Blocks of 16 mm, 4 mm apart: what is nearest to the hand between them is now one, now another.
TEST_F(CliMistake, AStrokeThatJumpsIsToldSo) {
  std::ostringstream keys;
  int first = 1;
  for (int i = -5; i <= 5; ++i) {
    for (int k = -5; k <= 5; ++k, first += 8) {
      for (int corner = 0; corner < 8; ++corner) {
        keys << "v " << 0.02 * i + ((corner & 4) != 0 ? 0.008 : -0.008) << ' '
             << ((corner & 2) != 0 ? 0.0 : -0.02) << ' '
             << 0.02 * k + ((corner & 1) != 0 ? 0.008 : -0.008) << '\n';
      }
      for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{{0, 1, 3, 2},
                                                                      {4, 6, 7, 5},
                                                                      {0, 4, 5, 1},
                                                                      {2, 3, 7, 6},
                                                                      {0, 2, 6, 4},
                                                                      {1, 5, 7, 3}}) {
        keys << "f " << first + a << ' ' << first + b << ' ' << first + c << ' ' << first + d
             << '\n';
      }
    }
  }
  write_file(path("keys.obj"), keys.str());
  const Ran jumps = nade("synth -o out.jsonl --object keys.obj --stroke zigzag --depth 0.02");
  EXPECT_EQ(jumps.status, 0) << jumps.err;
  EXPECT_NE(jumps.err.find("nade: keys.obj: the hand jumps, farthest by "), std::string::npos)
      << jumps.err;
  EXPECT_EQ(nade("synth -o out.jsonl --object sphere --stroke zigzag --speed 1").err, "");
}

TEST_F(CliMistake, UnknownJointNameIsNamed) {
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

TEST_F(CliMistake, PressThatCannotBeNamesTheRecording) {
  make_stroke("in.jsonl");
  write_file(path("bare.jsonl"), lines_of(read_file(path("in.jsonl")))[0] + "\n");
  const std::string press = " -o out.jsonl --press 0.1 --object ";
  expect_failure(nade("correct in.jsonl" + press + "sphere:0.01"), "in.jsonl: --press 0.1");
  expect_failure(nade("correct bare.jsonl" + press + "plane"), "bare.jsonl: --press 0.1");
  expect_failure(shell("\"$NADE\" correct - " + press + "plane <bare.jsonl"),
                 "standard input: --press 0.1");
  EXPECT_EQ(files(), (std::vector<std::string>{"bare.jsonl", "in.jsonl"}));
}

TEST_F(CliMistake, UnwritableOutputIsNamed) {
  make_stroke("in.jsonl");
  write_file(path("file"), "");
  std::filesystem::create_directory(path("folder"));
  for (const char* out : {"nowhere/out.jsonl", "file/out.jsonl", "folder"}) {
    SCOPED_TRACE(out);
    expect_failure(nade(std::string("synth --object plane --duration 0.5 -o ") + out), out);
    if (out == std::string("folder")) continue;  // of recordings
    expect_failure(nade(std::string("correct in.jsonl --object plane -o ") + out), out);
    expect_failure(nade(std::string("convert in.jsonl -o ") + out), out);
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"file", "folder", "in.jsonl"}));
  EXPECT_TRUE(std::filesystem::is_empty(path("folder")));
}

TEST_F(CliMistake, ARecordingIsNotWrittenUnderAnotherKindsName) {
  make_stroke("in.jsonl");
  for (const char* out :
       {"out.png", "out.json", "out.obj.gz", "out.jsonl.zip", "out.glb.gz", "out.mcap.gz"}) {
    const std::string expected =
        std::string("--output: expected a name ending in .jsonl, .jsonl.gz, .csv, .csv.gz, ") +
        ".mcap or .glb, found '" + out;
    expect_misuse(nade(std::string("correct in.jsonl --object plane -o ") + out), expected);
    expect_misuse(nade(std::string("convert in.jsonl -o ") + out), expected);
    expect_misuse(nade(std::string("synth --object plane -o ") + out), expected);
  }
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
  for (const char* out : {"out", "OUT.JSONL.GZ", "/dev/null"}) {
    EXPECT_EQ(nade(std::string("convert in.jsonl -o ") + out).status, 0) << out;
  }
}

TEST_F(CliMistake, FullDiskIsAnError) {
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

TEST_F(CliMistake, FailureKeepsWhatStoodThere) {
  make_stroke("in.jsonl");
  write_file(path("bad.jsonl"), read_file(path("in.jsonl")) + "nonsense\n{}\n");
  write_file(path("out.jsonl"), "precious");
  expect_failure(nade("correct bad.jsonl -o out.jsonl --object plane"), "bad.jsonl");
  EXPECT_EQ(read_file(path("out.jsonl")), "precious");
  EXPECT_EQ(files(), (std::vector<std::string>{"bad.jsonl", "in.jsonl", "out.jsonl"}));
}

}  // namespace
