#include "core/recording/vehicle_samples.h"

namespace odolab {

namespace {

const std::vector<AlignedChannel>& wheel_channels() {
  static const std::vector<AlignedChannel> channels = {{"left_wheel_rad"}, {"right_wheel_rad"}};
  return channels;
}

const std::vector<AlignedChannel>& synchro_channels() {
  static const std::vector<AlignedChannel> channels = {{"drive_wheel_rad"}, {"steering_rad"}};
  return channels;
}

const std::vector<AlignedChannel>& linked_channels() {
  static const std::vector<AlignedChannel> channels = {
      {"a_left_wheel_rad"},       {"a_right_wheel_rad"},      {"b_left_wheel_rad"}, {"b_right_wheel_rad"},
      {"link_angle_a_rad", true}, {"link_angle_b_rad", true}, {"link_length_m"}};
  return channels;
}

const std::vector<AlignedChannel>& trailer_channels() {
  static const std::vector<AlignedChannel> channels = {{"left_wheel_rad"},
                                                       {"right_wheel_rad"},
                                                       {"trailer_left_wheel_rad"},
                                                       {"trailer_right_wheel_rad"},
                                                       {"hitch_angle_rad", true}};
  return channels;
}

std::vector<AlignedChannel> castor_channels(std::size_t castors) {
  std::vector<AlignedChannel> channels;
  for (std::size_t i = 1; i <= castors; ++i) {
    const std::string castor = "castor" + std::to_string(i);
    channels.push_back({castor + "_left_wheel_rad"});
    channels.push_back({castor + "_right_wheel_rad"});
    channels.push_back({castor + "_pivot_rad", true});
  }
  return channels;
}

// Whose wheels may also be read in raw counts.
bool is_driven_by_a_pair(const VehicleKind& kind) {
  return std::holds_alternative<DifferentialDrive>(kind) || std::holds_alternative<Tracked>(kind);
}

// One sample for each row, made by `make(time_s, values)`.
template <typename Sample, typename Make>
std::vector<Sample> samples_of(const AlignedRows& rows, const Make& make) {
  std::vector<Sample> samples;
  samples.reserve(rows.time_s.size());
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) samples.push_back(make(rows.time_s[i], rows.values[i]));
  return samples;
}

// The inverse: a channel for each of the values that `values(sample)` gives.
template <typename Sample, typename Values>
Recording recording_by(const std::vector<Sample>& samples, const std::vector<AlignedChannel>& channels,
                       const Values& values) {
  Recording recording;
  for (const Sample& sample : samples) recording.time_s.push_back(sample.time_s);
  for (const AlignedChannel& channel : channels) recording.add_channel(channel.name);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::vector<double> row = values(samples[i]);
    for (std::size_t k = 0; k < channels.size(); ++k) recording.channels[k].values[i] = row[k];
  }
  return recording;
}

}  // namespace

std::vector<SynchroSample> synchro_samples(const Recording& recording) {
  return samples_of<SynchroSample>(aligned_rows(recording, synchro_channels()),
                                   [](double time_s, const std::vector<double>& v) {
                                     return SynchroSample{time_s, v[0], v[1]};
                                   });
}

std::vector<LinkedSample> linked_samples(const Recording& recording) {
  return samples_of<LinkedSample>(aligned_rows(recording, linked_channels()),
                                  [](double time_s, const std::vector<double>& v) {
                                    return LinkedSample{time_s, {v[0], v[1]}, {v[2], v[3]}, v[4], v[5], v[6]};
                                  });
}

std::vector<TrailerSample> trailer_samples(const Recording& recording) {
  return samples_of<TrailerSample>(aligned_rows(recording, trailer_channels()),
                                   [](double time_s, const std::vector<double>& v) {
                                     return TrailerSample{time_s, {v[0], v[1]}, {v[2], v[3]}, v[4]};
                                   });
}

std::vector<CastorSample> castor_samples(const Recording& recording, std::size_t castors) {
  return samples_of<CastorSample>(aligned_rows(recording, castor_channels(castors)),
                                  [&](double time_s, const std::vector<double>& v) {
                                    CastorSample sample{time_s, {}};
                                    for (std::size_t i = 0; i < castors; ++i)
                                      sample.castors.push_back({{v[3 * i], v[3 * i + 1]}, v[3 * i + 2]});
                                    return sample;
                                  });
}

Recording recording_of(const std::vector<SynchroSample>& samples) {
  return recording_by(samples, synchro_channels(), [](const SynchroSample& s) {
    return std::vector<double>{s.wheel_rad, s.steering_rad};
  });
}

Recording recording_of(const std::vector<LinkedSample>& samples) {
  return recording_by(samples, linked_channels(), [](const LinkedSample& s) {
    return std::vector<double>{s.a.left_rad,       s.a.right_rad,      s.b.left_rad,   s.b.right_rad,
                               s.link_angle_a_rad, s.link_angle_b_rad, s.link_length_m};
  });
}

Recording recording_of(const std::vector<TrailerSample>& samples) {
  return recording_by(samples, trailer_channels(), [](const TrailerSample& s) {
    return std::vector<double>{s.tow.left_rad, s.tow.right_rad, s.trailer.left_rad, s.trailer.right_rad,
                               s.hitch_angle_rad};
  });
}

Recording recording_of(const std::vector<CastorSample>& samples) {
  const std::size_t castors = samples.empty() ? 0 : samples.front().castors.size();
  return recording_by(samples, castor_channels(castors), [](const CastorSample& s) {
    std::vector<double> values;
    for (const CastorReading& c : s.castors)
      for (double v : {c.wheels.left_rad, c.wheels.right_rad, c.pivot_rad}) values.push_back(v);
    return values;
  });
}

std::vector<AlignedChannel> encoders_of(const VehicleKind& kind) {
  struct Of {
    std::vector<AlignedChannel> operator()(const DifferentialDrive&) const { return wheel_channels(); }
    std::vector<AlignedChannel> operator()(const Tracked&) const { return wheel_channels(); }
    std::vector<AlignedChannel> operator()(const SynchroDrive&) const { return synchro_channels(); }
    std::vector<AlignedChannel> operator()(const LinkedTrucks&) const { return linked_channels(); }
    std::vector<AlignedChannel> operator()(const EncoderTrailer&) const { return trailer_channels(); }
    std::vector<AlignedChannel> operator()(const SmartEncoderTrailer&) const { return trailer_channels(); }
    std::vector<AlignedChannel> operator()(const MultiCastor& v) const { return castor_channels(v.castors.size()); }
  };
  return std::visit(Of{}, kind);
}

std::vector<std::string> encoder_columns(const Vehicle& vehicle) {
  std::vector<std::string> names;
  if (is_driven_by_a_pair(vehicle.kind) || std::holds_alternative<SynchroDrive>(vehicle.kind)) return names;
  for (const AlignedChannel& channel : encoders_of(vehicle.kind)) names.push_back(channel.name);
  return names;
}

std::string missing_columns(const Recording& recording, const Vehicle& vehicle) {
  if (is_driven_by_a_pair(vehicle.kind) && missing_of(recording, {{"left_ticks"}, {"right_ticks"}}).empty()) return "";
  return missing_of(recording, encoders_of(vehicle.kind));
}

std::optional<Error> lacks_encoders(const Recording& recording, const Vehicle& vehicle) {
  const std::string missing = missing_columns(recording, vehicle);
  if (missing.empty()) return std::nullopt;
  return Error{recording.name.empty() ? "recording" : recording.name, "no " + missing,
               "the encoders of a " + kind_name(vehicle)};
}

}  // namespace odolab
