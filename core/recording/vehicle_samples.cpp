#include "core/recording/vehicle_samples.h"

#include "core/recording/aligned_rows.h"

namespace odolab {

namespace {

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

// One sample for each row, made by `make(time_s, values)`.
template <typename Sample, typename Make>
std::vector<Sample> samples_of(const AlignedRows& rows, const Make& make) {
  std::vector<Sample> samples;
  samples.reserve(rows.time_s.size());
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) samples.push_back(make(rows.time_s[i], rows.values[i]));
  return samples;
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

std::string missing_columns(const Recording& recording, const Vehicle& vehicle) {
  struct Of {
    const Recording& recording;
    std::string wheels() const {
      if (missing_of(recording, {{"left_ticks"}, {"right_ticks"}}).empty()) return "";
      return missing_of(recording, {{"left_wheel_rad"}, {"right_wheel_rad"}});
    }
    std::string operator()(const DifferentialDrive&) const { return wheels(); }
    std::string operator()(const Tracked&) const { return wheels(); }
    std::string operator()(const SynchroDrive&) const { return missing_of(recording, synchro_channels()); }
    std::string operator()(const LinkedTrucks&) const { return missing_of(recording, linked_channels()); }
    std::string operator()(const EncoderTrailer&) const { return missing_of(recording, trailer_channels()); }
    std::string operator()(const SmartEncoderTrailer&) const { return missing_of(recording, trailer_channels()); }
    std::string operator()(const MultiCastor& v) const {
      return missing_of(recording, castor_channels(v.castors.size()));
    }
  };
  return std::visit(Of{recording}, vehicle.kind);
}

}  // namespace odolab
