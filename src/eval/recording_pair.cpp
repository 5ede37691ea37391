#include "nade/eval/recording_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "nade/eval/quantile.h"
#include "nade/io/assets.h"
#include "nade/io/hand_file.h"

namespace nade {
namespace {

/// The drawn hands that a recording needs, and how large the person is.
struct Survey {
  std::array<std::optional<HandMesh>, 2> meshes{};
  double scale = 1.0;
  std::size_t frames = 0;
};

Status need_mesh(Handedness side, std::optional<HandMesh>& mesh) {
  if (mesh) return ok_status();
  const Result<std::string> file = find_asset(fmt::format("hands/{}.glb", name_of(side)));
  if (!file) return file.error();
  Result<HandMesh> loaded = load_hand_mesh(*file, side);
  if (!loaded) return loaded.error();
  mesh = std::move(loaded).value();
  return ok_status();
}

/// Reads the tracked recording once: one scale for the whole of it, from all its hands.
Result<Survey> survey(const std::string& path) {
  Result<RecordingReader> reader = RecordingReader::open(path);
  if (!reader) return reader.error();
  Survey seen;
  QuantileSketch scales;
  while (true) {
    const Result<std::optional<RecordedFrame>> frame = reader->next();
    if (!frame) return frame.error();
    if (!frame->has_value()) break;
    ++seen.frames;
    for (const auto& hand : (*frame)->hands) {
      if (!hand || !is_usable(hand->pose)) continue;
      auto& mesh = seen.meshes[index_of(hand->pose.side)];
      const Status there = need_mesh(hand->pose.side, mesh);
      if (!there) return there.error();
      scales.add(hand_scale(*mesh, hand->pose));
    }
  }
  seen.scale = scales.quantile(0.5).value_or(1.0);
  return seen;
}

/// How well two recordings went together.
struct Pairing {
  std::size_t pairs = 0;
  std::size_t only_tracked = 0;
  std::size_t only_corrected = 0;
  std::array<std::size_t, 2> missing{};  ///< hands tracked but not corrected
};

using BeforeFrame = std::function<void(std::int64_t time_ns)>;

/// A meter for each hand that was drawn.
using Meters = std::array<std::optional<MetricsMeter>, 2>;

void measure_pair(const RecordedFrame& tracked, const RecordedFrame& corrected,
                  const Object& object, Meters& meters, Pairing& pairing) {
  for (std::size_t side = 0; side < meters.size(); ++side) {
    if (!meters[side]) continue;
    const auto& before = tracked.hands[side];
    const auto& after = corrected.hands[side];
    if (before && !after && is_usable(before->pose)) ++pairing.missing[side];
    if (before && after && after->status != HandStatus::untracked) {
      meters[side]->add(tracked.time_ns, before->pose, after->pose, object);
    } else {
      meters[side]->add_gap();
    }
  }
}

void finish_meters(Meters& meters, PairMetrics& metrics) {
  std::optional<std::size_t> first;
  for (std::size_t side = 0; side < meters.size(); ++side) {
    if (!meters[side]) continue;
    metrics.hands[side] = meters[side]->finish();
    if (!first) {
      first = side;
    } else {
      meters[*first]->merge(*meters[side]);
    }
  }
  if (first) metrics.both = meters[*first]->finish();
}

}  // namespace

struct RecordingPair::Impl {
  std::string tracked_name;
  std::string corrected_name;
  Survey seen;
  RecordingReader tracked;
  RecordingReader corrected;

  Result<Pairing> measure_all(const Object& object, const BeforeFrame& before_frame,
                              Meters& meters);
  Status check_pairing(const Pairing& pairing, std::vector<std::string>& warnings) const;
};

/// Pairs the frames by their times.
Result<Pairing> RecordingPair::Impl::measure_all(const Object& object,
                                                 const BeforeFrame& before_frame, Meters& meters) {
  Pairing pairing;
  Result<std::optional<RecordedFrame>> before = tracked.next();
  Result<std::optional<RecordedFrame>> after = corrected.next();
  while (true) {
    if (!before) return before.error();
    if (!after) return after.error();
    if (!before->has_value() && !after->has_value()) return pairing;
    const bool has_before =
        before->has_value() && (!after->has_value() || (*before)->time_ns <= (*after)->time_ns);
    const bool has_after =
        after->has_value() && (!before->has_value() || (*after)->time_ns <= (*before)->time_ns);
    if (has_before && before_frame) before_frame((*before)->time_ns);
    if (has_before && has_after) {
      measure_pair(**before, **after, object, meters, pairing);
      ++pairing.pairs;
    } else {
      ++(has_before ? pairing.only_tracked : pairing.only_corrected);
    }
    if (has_before) before = tracked.next();
    if (has_after) after = corrected.next();
  }
}

/// Refuses recordings that do not belong together, and says where they differ.
Status RecordingPair::Impl::check_pairing(const Pairing& pairing,
                                          std::vector<std::string>& warnings) const {
  const std::size_t unpaired = pairing.only_tracked + pairing.only_corrected;
  const std::size_t all = pairing.pairs + std::max(pairing.only_tracked, pairing.only_corrected);
  const std::string sentence =
      fmt::format("{}: {} of {} frames have a partner of the same time in {}", corrected_name,
                  pairing.pairs, all, tracked_name);
  if (2 * pairing.pairs < all) {
    return Error{ErrorCode::bad_value,
                 sentence + ", expected the corrected form of that recording"};
  }
  if (unpaired > 0) warnings.push_back(sentence + ", only those are measured");
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    const std::size_t missing = pairing.missing[index_of(side)];
    if (missing == 0) continue;
    warnings.push_back(
        fmt::format("{}: has no {} hand in {} frames where {} has one, they are not measured",
                    corrected_name, name_of(side), missing, tracked_name));
  }
  for (const RecordingReader* reader : {&tracked, &corrected}) {
    for (std::string& warning : reader->warnings()) warnings.push_back(std::move(warning));
  }
  return ok_status();
}

Result<RecordingPair> RecordingPair::open(const std::string& tracked_path,
                                          const std::string& tracked_name,
                                          const std::string& corrected_path) {
  Result<Survey> seen = survey(tracked_path);
  if (!seen) return seen.error();
  Result<RecordingReader> tracked = RecordingReader::open(tracked_path);
  if (!tracked) return tracked.error();
  Result<RecordingReader> corrected = RecordingReader::open(corrected_path);
  if (!corrected) return corrected.error();
  return RecordingPair(
      std::make_unique<Impl>(Impl{tracked_name, corrected_path, std::move(seen).value(),
                                  std::move(tracked).value(), std::move(corrected).value()}));
}

RecordingPair::RecordingPair(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingPair::RecordingPair(RecordingPair&&) noexcept = default;
RecordingPair& RecordingPair::operator=(RecordingPair&&) noexcept = default;
RecordingPair::~RecordingPair() = default;

const RecordingHeader& RecordingPair::corrected_header() const { return impl_->corrected.header(); }

std::size_t RecordingPair::frames() const { return impl_->seen.frames; }

Result<PairMetrics> RecordingPair::measure(const Object& object, const BeforeFrame& before_frame) {
  PairMetrics metrics;
  metrics.hand_scale = impl_->seen.scale;
  Meters meters;
  for (std::size_t side = 0; side < meters.size(); ++side) {
    const auto& mesh = impl_->seen.meshes[side];
    if (mesh) meters[side].emplace(*mesh, MetricsOptions{metrics.hand_scale});
  }
  const Result<Pairing> pairing = impl_->measure_all(object, before_frame, meters);
  if (!pairing) return pairing.error();
  const Status fits = impl_->check_pairing(*pairing, metrics.warnings);
  if (!fits) return fits.error();
  finish_meters(meters, metrics);
  return metrics;
}

std::string method_of(const RecordingHeader& header) {
  const auto json = nlohmann::json::parse(header.unknown_json, nullptr, false);
  if (!json.is_object() || !json.contains("method") || !json["method"].is_string()) return {};
  return json["method"].get<std::string>();
}

}  // namespace nade
