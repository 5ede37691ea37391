// What `nade xr` says before it asks for a headset, which need not be there.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/cli_run.h"

namespace {

using nade::test::read_file;
using nade::test::write_file;

class XrCommand : public nade::test::CliTest {};

TEST_F(XrCommand, WhatCannotBeWrittenIsSaidBeforeTheHeadsetStarts) {
  expect_failure(nade("xr --record nodir/x.jsonl"),
                 "nodir/x.jsonl: expected to write the output, but: No such file or directory");
  expect_failure(nade("xr --panel-log nodir/x.jsonl"),
                 "nodir/x.jsonl: expected to write the panel log, but: No such file or directory");
  expect_failure(nade("xr --frames 1 --screenshot nodir/eyes.png"),
                 "nodir/eyes-left.png: expected to write the output");
  expect_misuse(nade("xr --eye-scale 3"), "--eye-scale: expected a number from 0.1 to 2");
  expect_misuse(nade("xr --record /dev/null"), "--record: expected the name of a file");
  EXPECT_EQ(files(), std::vector<std::string>{});
}

TEST_F(XrCommand, ARecordingThatNobodyNamedIsNotReplaced) {
  write_file(path("x-corrected.jsonl"), "dear to somebody\n");
  expect_failure(nade("xr --record x.jsonl"),
                 "x-corrected.jsonl: the corrected hands of --record x.jsonl would replace it");
  EXPECT_EQ(files(), std::vector<std::string>{"x-corrected.jsonl"});
  EXPECT_EQ(read_file(path("x-corrected.jsonl")), "dear to somebody\n");
}

}  // namespace
