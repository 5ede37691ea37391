// `nade inspect --plot`: a page about a recording.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "support/cli_run.h"

namespace nade {
namespace {

using test::read_file;
using test::write_file;

bool have_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

class InspectPlot : public test::CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    make_stroke("in.jsonl");
  }
};

TEST_F(InspectPlot, ThePageSaysWhatItShows) {
  if (!have_gnuplot()) GTEST_SKIP() << "there is no gnuplot";
  const test::Ran plain = nade("inspect in.jsonl");
  const test::Ran ran = nade("inspect in.jsonl --plot page.svg");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, plain.out);
  const std::string page = read_file(path("page.svg"));
  for (const char* const text :
       {"in.jsonl", "54 frames in 0.6 s, 90.0 a second", "right hand", "palm, mm", "little",
        "speed of the palm", "tremble of the palm", "length of the hand"}) {
    EXPECT_NE(page.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(page.find("left hand"), std::string::npos);
  EXPECT_EQ(page.find("no hand"), std::string::npos);
}

TEST_F(InspectPlot, GapsAreShown) {
  if (!have_gnuplot()) GTEST_SKIP() << "there is no gnuplot";
  // Every frame from the 20th to the 30th without its hand.
  const test::Ran cut = shell("sed '21,31s/,\"right\".*/}/' in.jsonl > gap.jsonl");
  ASSERT_EQ(cut.status, 0);
  ASSERT_EQ(nade("inspect gap.jsonl --plot page.svg").status, 0);
  const std::string page = read_file(path("page.svg"));
  EXPECT_NE(page.find("red where there is no hand"), std::string::npos);
}

TEST_F(InspectPlot, TheEndingSaysWhichPicture) {
  if (!have_gnuplot()) GTEST_SKIP() << "there is no gnuplot";
  ASSERT_EQ(nade("inspect in.jsonl --plot page.png").status, 0);
  EXPECT_EQ(read_file(path("page.png")).substr(1, 3), "PNG");
  ASSERT_EQ(shell("\"$NADE\" inspect - --plot page.pdf < in.jsonl").status, 0);
  EXPECT_EQ(read_file(path("page.pdf")).substr(0, 4), "%PDF");
}

TEST_F(InspectPlot, NamesOfFilesAreNeverCommands) {
  if (!have_gnuplot()) GTEST_SKIP() << "there is no gnuplot";
  ASSERT_EQ(shell("cp in.jsonl \"it's \\`touch gone\\`.jsonl\"; \"$NADE\" inspect \"it's \\`touch "
                  "gone\\`.jsonl\" --plot page.svg")
                .status,
            0);
  EXPECT_FALSE(std::filesystem::exists(path("gone")));
}

TEST_F(InspectPlot, WhatCannotBePlottedIsSaid) {
  expect_misuse(nade("inspect in.jsonl in.jsonl --plot page.svg"),
                "--plot: expected one recording");
  expect_misuse(nade("inspect . --plot page.svg"), "--plot: expected one recording");
  expect_misuse(nade("inspect in.jsonl --plot page.jpg"), "ending in .svg, .pdf or .png");
  write_file(path("none.jsonl"),
             "{\"format\":\"nade-recording\",\"version\":1,\"source\":\"test\"}\n{\"t\":0}\n");
  expect_failure(nade("inspect none.jsonl --plot page.svg"), "expected a hand to plot, found none");
  expect_failure(shell("PATH=/nowhere \"$NADE\" inspect in.jsonl --plot page.svg"),
                 "gnuplot is not installed");
  EXPECT_FALSE(std::filesystem::exists(path("page.svg")));
}

}  // namespace
}  // namespace nade
