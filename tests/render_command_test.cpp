// `nade render` and `nade figure` as a person meets them: files, sizes, refusals.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/cli_run.h"

namespace {

using nade::test::CliTest;
using nade::test::Ran;
using nade::test::read_file;
using nade::test::write_file;

/// Width and height as a PNG file's header has them; zeros where it is none.
struct Size {
  unsigned width = 0;
  unsigned height = 0;
};
Size png_size(const std::string& path) {
  const std::string bytes = read_file(path);
  if (bytes.size() < 24 || bytes.compare(1, 3, "PNG") != 0) return {};
  const auto number = [&bytes](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = 256U * value + static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  };
  return {number(16), number(20)};
}

class RenderCommand : public CliTest {
 protected:
  /// A quick picture: small, of the object that the recording names.
  [[nodiscard]] Ran render(const std::string& arguments) const {
    return nade("render --size 160x120 " + arguments);
  }
  [[nodiscard]] bool has_ffmpeg() const { return shell("command -v ffmpeg").status == 0; }
};

TEST_F(RenderCommand, PictureOfTheDeepestPress) {
  make_stroke("in.jsonl");
  const Ran ran = render("in.jsonl -o out.png");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err, "");
  const Size size = png_size(path("out.png"));
  EXPECT_EQ(size.width, 160u);
  EXPECT_EQ(size.height, 120u);
}

TEST_F(RenderCommand, TheSameTwice) {
  make_stroke("in.jsonl", "--object dog");
  ASSERT_EQ(render("in.jsonl -o one.png --overlay rays,contacts,normals,labels").status, 0);
  ASSERT_EQ(render("in.jsonl -o two.png --overlay rays,contacts,normals,labels").status, 0);
  EXPECT_EQ(read_file(path("one.png")), read_file(path("two.png")));
}

TEST_F(RenderCommand, FrameAndTimeNameTheSameMoment) {
  make_stroke("in.jsonl", "--object plane --rate 100");
  ASSERT_EQ(render("in.jsonl -o frame.png --frame 30").status, 0);
  ASSERT_EQ(render("in.jsonl -o time.png --time 0.3").status, 0);
  ASSERT_EQ(render("in.jsonl -o other.png --time 0.1").status, 0);
  EXPECT_EQ(read_file(path("frame.png")), read_file(path("time.png")));
  EXPECT_NE(read_file(path("frame.png")), read_file(path("other.png")));
}

TEST_F(RenderCommand, ShowsWhatWasAsked) {
  make_stroke("in.jsonl", "--object sphere");
  std::vector<std::string> pictures;
  for (const std::string& shown : std::vector<std::string>{
           "--show raw", "--show corrected", "--show both", "--show both --view side", "--view top",
           "--view front", "--view first-person", "--eye 0.3,0.2,0.3",
           "--eye 0.3,0.2,0.3 --target 0,0,0 --fov 50", "--overlay penetration --show raw",
           "--overlay held-ray,labels", "--method none --show both --overlay normals",
           "--hand-right \"$(dirname $NADE)/../share/nade/hands/right.glb\" --view side"}) {
    const Ran ran = render("in.jsonl -o out.png " + shown);
    ASSERT_EQ(ran.status, 0) << shown << "\n" << ran.err;
    pictures.push_back(read_file(path("out.png")));
  }
  std::sort(pictures.begin(), pictures.end());
  EXPECT_EQ(std::unique(pictures.begin(), pictures.end()), pictures.end());
}

TEST_F(RenderCommand, CorrectedRecordingBesideAndAlone) {
  make_stroke("in.jsonl");
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object plane").status, 0);
  EXPECT_EQ(render("in.jsonl out.jsonl -o both.png --show both --overlay rays").status, 0);
  EXPECT_EQ(render("out.jsonl -o alone.png").status, 0);
  EXPECT_EQ(render("out.jsonl -o alone.png --show both").status, 2);
  expect_failure(render("out.jsonl in.jsonl -o wrong.png"), "out.jsonl");
  ASSERT_EQ(nade("synth -o other.jsonl --object plane --duration 0.6 --rate 70").status, 0);
  ASSERT_EQ(nade("correct other.jsonl -o other-out.jsonl --object plane").status, 0);
  expect_failure(render("in.jsonl other-out.jsonl -o wrong.png"), "other-out.jsonl");
  expect_failure(render("in.jsonl other.jsonl -o wrong.png"),
                 "other.jsonl: expected a corrected recording second, found a tracked one");
  EXPECT_FALSE(std::filesystem::exists(path("wrong.png")));
}

TEST_F(RenderCommand, NumberedPictures) {
  make_stroke("in.jsonl");
  const Ran ran = render("in.jsonl -o walk-%03d.png --from 0.1 --to 0.3 --fps 20");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(files(), (std::vector<std::string>{"in.jsonl", "walk-000.png", "walk-001.png",
                                               "walk-002.png", "walk-003.png", "walk-004.png"}));
  EXPECT_EQ(png_size(path("walk-004.png")).width, 160u);
  EXPECT_EQ(render("in.jsonl -o 50%-%d-100%.png --from 0.1 --to 0.1").status, 0);
  EXPECT_TRUE(std::filesystem::exists(path("50%-0-100%.png")));
}

TEST_F(RenderCommand, FilmOfALeftAndARightHand) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  for (const std::string hand : {"left", "right"}) {
    make_stroke("in.jsonl", "--object plane --hand " + hand);
    const Ran ran = render("in.jsonl -o film.mp4 --fps 10 --slow 2 --follow smooth --show both");
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    const std::string film = read_file(path("film.mp4"));
    EXPECT_GT(film.size(), 2000u);
    EXPECT_EQ(film.compare(4, 4, "ftyp"), 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"film.mp4", "in.jsonl"}));
  }
}

TEST_F(RenderCommand, FilmWithoutFfmpegIsOneSentence) {
  make_stroke("in.jsonl");
  expect_failure(shell("PATH= \"$NADE\" render in.jsonl -o film.mp4"), "ffmpeg");
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
}

TEST_F(RenderCommand, FailingEncoderIsOneSentence) {
  make_stroke("in.jsonl");
  std::filesystem::create_directory(path("bin"));
  write_file(path("bin/ffmpeg"), "#!/bin/sh\necho 'no such encoder' >&2\nexit 3\n");
  ASSERT_EQ(shell("chmod +x bin/ffmpeg").status, 0);
  expect_failure(
      shell("PATH=\"$PWD/bin:$PATH\" \"$NADE\" render --size 320x240 in.jsonl -o film.mp4"),
      "no such encoder");
  EXPECT_FALSE(std::filesystem::exists(path("film.mp4")));
}

TEST_F(RenderCommand, RefusesWithTwo) {
  make_stroke("in.jsonl");
  for (const std::string& arguments :
       std::vector<std::string>{"in.jsonl",
                                "in.jsonl -o out.gif",
                                "in.jsonl -o out-%s.png --from 0",
                                "in.jsonl -o out.png --frame 9999",
                                "in.jsonl -o out.png --frame 1 --time 0.1",
                                "in.jsonl -o out.png --time 99",
                                "in.jsonl -o out.png --from 0.1",
                                "in.jsonl -o out-%03d.png --frame 1",
                                "in.jsonl -o out-%03d.png --from 0.4 --to 0.2",
                                "in.jsonl -o out.png --view below",
                                "in.jsonl -o out.png --eye 1,2",
                                "in.jsonl -o out.png --eye 1e9,0,0",
                                "in.jsonl -o out.png --eye 1,1,1 --target 1,1,1",
                                "in.jsonl -o out.png --size 0x10",
                                "in.jsonl -o out.png --size big",
                                "in.jsonl -o out.png --overlay rays,everything",
                                "in.jsonl -o out.png --show all",
                                "in.jsonl -o out.png --follow me",
                                "in.jsonl -o film.mp4 --size 161x120",
                                "in.jsonl -o film.mp4 --fps 0",
                                "in.jsonl -o film.mp4 --fps nan",
                                "in.jsonl -o film.mp4 --slow nan",
                                "in.jsonl -o film.mp4 --from nan",
                                "in.jsonl -o out.png --time nan",
                                "in.jsonl -o out.png --fov nan",
                                "in.jsonl -o out.png --frame -1"}) {
    const Ran ran = render(arguments);
    EXPECT_EQ(ran.status, 2) << arguments << "\n" << ran.err;
    EXPECT_NE(ran.err, "") << arguments;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"in.jsonl"});
}

TEST_F(RenderCommand, DrawsOverNothingThatIsShown) {
  make_stroke("in.jsonl");
  std::filesystem::rename(path("in.jsonl"), path("in.png"));
  const std::string before = read_file(path("in.png"));
  expect_misuse(render("in.png -o in.png"), "--output: expected another file than that of IN");
  expect_misuse(nade("figure in.png -o in.png"), "--output: expected another file");
  EXPECT_EQ(read_file(path("in.png")), before);
}

TEST_F(RenderCommand, WhatWasCorrectedIsNotCorrectedAnew) {
  make_stroke("in.jsonl");
  ASSERT_EQ(nade("correct in.jsonl -o out.jsonl --object plane").status, 0);
  for (const char* recordings : {"in.jsonl out.jsonl", "out.jsonl"}) {
    for (const char* option : {"--method nade", "--paper-literal", "--friction 1"}) {
      expect_misuse(render(std::string(recordings) + " -o no.png " + option),
                    "cannot be used with a corrected recording");
    }
    EXPECT_EQ(render(std::string(recordings) + " -o soft.png --softness 5").status, 0);
  }
}

TEST_F(RenderCommand, NamesWhatCannotBeUsed) {
  make_stroke("in.jsonl");
  expect_failure(render("nowhere.jsonl -o out.png"), "nowhere.jsonl");
  expect_failure(render("in.jsonl nowhere.jsonl -o out.png"), "nowhere.jsonl");
  expect_failure(render("in.jsonl -o nowhere/out.png"), "nowhere/out.png");
  expect_failure(render("in.jsonl -o nowhere/out.mp4"), "nowhere/out.mp4");
  expect_failure(render("in.jsonl -o out.png --object nowhere.glb"), "nowhere.glb");
  expect_failure(render("in.jsonl -o out.png --hand-left nowhere.glb"), "nowhere.glb");
  write_file(path("empty.jsonl"), "{\"format\":\"nade-recording\",\"version\":1}\n{\"t\":0}\n");
  expect_failure(render("empty.jsonl -o out.png --object plane"), "empty.jsonl");
  EXPECT_EQ(files(), (std::vector<std::string>{"empty.jsonl", "in.jsonl"}));
}

TEST_F(RenderCommand, StandardInputIsNamedAsSuch) {
  make_stroke("in.jsonl");
  const Ran ran = shell("\"$NADE\" render --size 160x120 - -o out.png <in.jsonl");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(png_size(path("out.png")).width, 160u);
  expect_failure(shell("echo nonsense | \"$NADE\" render - -o no.png"), "standard input");
  expect_failure(shell("echo nonsense | \"$NADE\" render in.jsonl - -o no.png"), "standard input");
  expect_misuse(nade("render - - -o no.png"), "IN and CORRECTED cannot both be standard input");
}

TEST_F(RenderCommand, FigureOfOnesOwnRecording) {
  make_stroke("in.jsonl", "--object sphere:0.1");
  const Ran ran = nade("figure in.jsonl -o sheet.png --method paper,none");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.err, "");
  EXPECT_EQ(png_size(path("sheet.png")).width, 3840u);
  EXPECT_EQ(nade("figure -o no.png --method magic").status, 2);
  EXPECT_EQ(nade("figure -o no.png --frame 3").status, 2);
  EXPECT_EQ(nade("figure in.jsonl -o no.png --frame 9999").status, 2);
  EXPECT_EQ(nade("figure in.jsonl -o no.png --time 99").status, 2);
  expect_misuse(nade("figure in.jsonl -o no.jpg"),
                "--output: expected a name ending in .png, found 'no.jpg'");
  expect_misuse(nade("figure in.jsonl -o no.png --frame -1"),
                "--frame: expected a whole number, found '-1'");
  expect_failure(nade("figure nowhere.jsonl -o no.png"), "nowhere.jsonl");
  EXPECT_EQ(files(), (std::vector<std::string>{"in.jsonl", "sheet.png"}));
}

TEST_F(RenderCommand, FigureTitleEndsBeforeThePictures) {
  make_stroke("in.jsonl");
  std::vector<std::string> sheets;
  for (const char letter : {'i', 'W'}) {
    const std::string object = "a_statue_that_was_scanned" + std::string(40, letter) + ".obj";
    write_file(path(object),
               "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
    const Ran ran = nade("figure in.jsonl -o sheet.png --method none --object " + object);
    ASSERT_EQ(ran.status, 0) << ran.err;
    sheets.push_back(read_file(path("sheet.png")));
  }
  EXPECT_TRUE(sheets[0] == sheets[1]) << "what tells the names apart is cut off";
}

/// Two methods side by side, and what is which only in the key.
TEST_F(RenderCommand, PairsToBeComparedBlind) {
  const std::string one = "--count 2 --scenes none --filter 'plane line 0.1 m/s'";
  const Ran ran = nade("figure --pairs asked " + one);
  ASSERT_EQ(ran.status, 0) << ran.err;
  for (const char* const name : {"pair_001.png", "pair_002.png"}) {
    EXPECT_EQ(png_size(path(std::string("asked/") + name)).width, 1328u) << name;
  }
  EXPECT_EQ(read_file(path("asked/answers.csv")), "pair,answer\npair_001,\npair_002,\n");
  const std::string key = read_file(path("asked/key.csv"));
  EXPECT_TRUE(key.starts_with("pair,case,time_s,left,right\npair_001,plane line")) << key;
  EXPECT_NE(key.find("paper"), std::string::npos);
  const std::string page = read_file(path("asked/index.html"));
  EXPECT_NE(page.find("pair_002.png"), std::string::npos);
  EXPECT_EQ(page.find("paper"), std::string::npos) << "blind";
  ASSERT_EQ(nade("figure --pairs again " + one).status, 0);
  EXPECT_EQ(read_file(path("again/key.csv")), key) << "the same for a seed";
  EXPECT_EQ(nade("figure --pairs no --method nade").status, 2);
  EXPECT_EQ(nade("figure --pairs no -o no.png").status, 2);
  EXPECT_EQ(nade("figure --pairs no --filter nothing-like-it").status, 2);
  EXPECT_EQ(nade("figure -o no.png --count 3").status, 2);
}

TEST_F(RenderCommand, PairsAsFilms) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const Ran ran = nade(
      "figure --pairs asked --films 0.1 --count 1 --scenes none --filter 'plane line 0.1 m/s'");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_GT(read_file(path("asked/pair_001.mp4")).size(), 10000U);
  EXPECT_NE(read_file(path("asked/index.html")).find("pair_001.mp4"), std::string::npos);
}

}  // namespace
