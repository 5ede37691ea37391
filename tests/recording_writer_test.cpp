#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <thread>

#include "nade/io/recording.h"
#include "support/recording_files.h"
#include "support/sanitized.h"

namespace nade {
namespace {

using test::contains;
using test::random_hand;
using test::read_whole;
using test::WholeRecording;

class WrittenRecording : public test::RecordingFiles {};

TEST_F(WrittenRecording, AppearsOnlyWhenFinished) {
  static_cast<void>(given("out.jsonl", "precious"));
  {
    Result<RecordingWriter> writer = RecordingWriter::create(path("out.jsonl"), {});
    ASSERT_TRUE(writer.ok());
    EXPECT_TRUE(writer->write({}).ok());
    EXPECT_EQ(test::read_file(path("out.jsonl")), "precious");
  }
  EXPECT_EQ(test::read_file(path("out.jsonl")), "precious");
  EXPECT_EQ(files(), std::vector<std::string>{"out.jsonl"});
  write_random("out.jsonl", 2);
  EXPECT_EQ(read_whole(path("out.jsonl")).frames.size(), 2u);
  EXPECT_EQ(files(), std::vector<std::string>{"out.jsonl"});
}

TEST_F(WrittenRecording, PermissionsFollowTheMask) {
  const mode_t before = ::umask(027);
  write_random("out.jsonl", 1);
  ::umask(before);
  struct stat info {};
  ASSERT_EQ(::stat(path("out.jsonl").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0640U);
}

TEST_F(WrittenRecording, PermissionsOfWhatIsReplacedStay) {
  for (const mode_t mode : {0600U, 0664U}) {
    static_cast<void>(given("out.jsonl", "old"));
    ASSERT_EQ(::chmod(path("out.jsonl").c_str(), mode), 0);
    write_random("out.jsonl", 1);
    struct stat info {};
    ASSERT_EQ(::stat(path("out.jsonl").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, mode);
  }
}

TEST_F(WrittenRecording, NameAsLongAsCanBe) {
  const std::string name = std::string(249, 'n') + ".jsonl";
  write_random(name, 2);
  EXPECT_EQ(files(), std::vector<std::string>{name});
}

TEST_F(WrittenRecording, EndingInCapitalsIsGzipToo) {
  write_random("out.jsonl.GZ", 2);
  EXPECT_TRUE(test::read_file(path("out.jsonl.GZ")).starts_with("\x1F\x8B"));
}

TEST_F(WrittenRecording, LinkToNothingIsWrittenThrough) {
  std::filesystem::create_symlink("next.jsonl", path("link.jsonl"));
  std::filesystem::create_symlink("target.jsonl", path("next.jsonl"));
  write_random("link.jsonl", 3);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.jsonl")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("next.jsonl")));
  EXPECT_EQ(read_whole(path("target.jsonl")).frames.size(), 3u);

  std::filesystem::create_symlink("loop.jsonl", path("loop.jsonl"));
  const Result<RecordingWriter> writer = RecordingWriter::create(path("loop.jsonl"), {});
  ASSERT_FALSE(writer.ok());
  EXPECT_TRUE(contains(writer.error().message, "symbolic links")) << writer.error().message;
}

TEST_F(WrittenRecording, LinkIsWrittenThrough) {
  static_cast<void>(given("target.jsonl", "old"));
  std::filesystem::create_symlink("target.jsonl", path("link.jsonl"));
  write_random("link.jsonl", 3);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.jsonl")));
  EXPECT_EQ(read_whole(path("target.jsonl")).frames.size(), 3u);
}

TEST_F(WrittenRecording, FullDiskIsReported) {
  std::mt19937 random(3);
  Result<RecordingWriter> writer = RecordingWriter::create("/dev/full", {});
  std::string message = writer ? "" : writer.error().message;
  for (int i = 0; message.empty() && i < 100; ++i) {
    RecordedFrame frame;
    frame.time_ns = i;
    frame.hands[0] = random_hand(Handedness::left, random);
    const Status status = writer->write(frame);
    if (!status.ok()) message = status.error().message;
  }
  EXPECT_TRUE(contains(message, "/dev/full: expected to write the output, but: No space left"))
      << message;

  Result<RecordingWriter> small = RecordingWriter::create("/dev/full", {});
  ASSERT_TRUE(small.ok());  // still in the buffer
  const Status finished = small->finish();
  ASSERT_FALSE(finished.ok());
  EXPECT_TRUE(contains(finished.error().message, "No space left"));
}

TEST_F(WrittenRecording, UnwritablePlacesAreNamed) {
  for (const std::string& place : {path("none/out.jsonl"), path("."), std::string()}) {
    const Result<RecordingWriter> writer = RecordingWriter::create(place, {});
    ASSERT_FALSE(writer.ok()) << place;
    EXPECT_EQ(writer.error().code, ErrorCode::unwritable);
    EXPECT_TRUE(contains(writer.error().message, place));
  }
}

TEST_F(WrittenRecording, DevicesAndPipesAreWrittenDirectly) {
  Result<RecordingWriter> null = RecordingWriter::create("/dev/null", {});
  ASSERT_TRUE(null.ok());
  EXPECT_TRUE(null->finish().ok());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));

  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::thread writer([&] { write_random("pipe", 30); });
  const WholeRecording whole = read_whole(path("pipe"));
  writer.join();
  EXPECT_EQ(whole.error, "");
  EXPECT_EQ(whole.frames.size(), 30u);
}

TEST_F(WrittenRecording, WriterRefusesWhatItsReaderWould) {
  std::mt19937 random(5);
  Result<RecordingWriter> writer = RecordingWriter::create(path("out.jsonl"), {});
  ASSERT_TRUE(writer.ok());
  RecordedFrame frame;
  frame.time_ns = 10;
  frame.hands[1] = random_hand(Handedness::right, random);
  ASSERT_TRUE(writer->write(frame).ok());
  EXPECT_FALSE(writer->write(frame).ok());
  frame.time_ns = 20;
  frame.hands[1]->pose.joints[2].position.y() = std::nan("");
  const Status status = writer->write(frame);
  ASSERT_FALSE(status.ok());
  EXPECT_TRUE(contains(status.error().message, "right: expected finite numbers"));
  const auto refusal = [&](const std::function<void(HandPose&)>& spoil) {
    frame.hands[1] = random_hand(Handedness::right, random);
    spoil(frame.hands[1]->pose);
    const Status refused = writer->write(frame);
    return refused.ok() ? "" : refused.error().message;
  };
  frame.time_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(contains(refusal([](HandPose&) {}), "expected a time up to 4000000000000000000 ns"));
  frame.time_ns = 20;
  EXPECT_EQ(refusal([](HandPose& hand) { hand.joints[2].position.x() = -1e7; }),
            path("out.jsonl") +
                ": frame at 20 ns: right: expected numbers up to 1000000 to write, "
                "found 10000000");
  EXPECT_TRUE(contains(refusal([](HandPose& hand) { hand.radius[3] = -0.5; }),
                       "expected a radius of 0 or more to write, found -0.5"));
  EXPECT_TRUE(contains(refusal([](HandPose& hand) { hand.confidence = 1.5; }),
                       "expected a confidence from 0 to 1 to write, found 1.5"));
  frame.hands[1] = random_hand(Handedness::right, random);
  EXPECT_TRUE(writer->write(frame).ok());
  ASSERT_TRUE(writer->finish().ok());
  EXPECT_EQ(read_whole(path("out.jsonl")).frames.size(), 2u);
}

TEST_F(WrittenRecording, WhatWasFlushedCanBeReadBeforeTheEnd) {
  std::mt19937 random(7);
  for (const std::string name : {"now.jsonl", "now.jsonl.gz"}) {
    Result<RecordingWriter> writer =
        RecordingWriter::create(path(name), {}, OutputFile::Appears::at_once);
    ASSERT_TRUE(writer.ok());
    RecordedFrame frame;
    frame.hands[1] = random_hand(Handedness::right, random);
    ASSERT_TRUE(writer->write(frame).ok());
    ASSERT_TRUE(writer->flush().ok());
    EXPECT_EQ(read_whole(path(name)).frames.size(), 1u) << name;
    frame.time_ns = 11111111;
    ASSERT_TRUE(writer->write(frame).ok());
    ASSERT_TRUE(writer->finish().ok());
    const WholeRecording whole = read_whole(path(name));
    EXPECT_EQ(whole.frames.size(), 2u) << name;
    EXPECT_TRUE(whole.warnings.empty()) << name;
    EXPECT_FALSE(RecordingWriter::create(path(name), {}, OutputFile::Appears::at_once).ok());
  }
}

#if !defined(NADE_SANITIZED)
TEST_F(WrittenRecording, TenMinutesNeedNoMoreMemoryThanOne) {
  const auto peak_kib = [] {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const auto pass_through = [&](std::size_t frames) {
    write_random("in.jsonl", frames);
    Result<RecordingReader> reader = RecordingReader::open(path("in.jsonl"));
    ASSERT_TRUE(reader.ok());
    Result<RecordingWriter> writer = RecordingWriter::create(path("out.jsonl"), reader->header());
    ASSERT_TRUE(writer.ok());
    std::size_t count = 0;
    while (true) {
      const auto frame = reader->next();
      ASSERT_TRUE(frame.ok());
      if (!*frame) break;
      ASSERT_TRUE(writer->write(**frame).ok());
      ++count;
    }
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_EQ(count, frames);
  };
  constexpr std::size_t kFramesInMinute = 30 * 60;
  pass_through(kFramesInMinute);
  const auto after_one = peak_kib();
  pass_through(10 * kFramesInMinute);
  EXPECT_LT(peak_kib() - after_one, 4096);
}
#endif

}  // namespace
}  // namespace nade
