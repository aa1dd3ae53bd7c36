#include "core/vehicle/parameters.h"

namespace odolab {

namespace {

using In = ParameterUnit;

struct Lister {
  std::vector<VehicleParameter>* list;
  std::string group;

  void add(const char* label, In unit, double& value, const char* about, bool machine_has_its_own = true) const {
    list->push_back({group, label, about, unit, &value, machine_has_its_own});
  }
  Lister in(const std::string& name) const { return {list, name}; }

  void wheels(DifferentialDrive& drive) const {
    add("radius left", In::metres, drive.wheel_radius_left_m, "Rolling radius of the left wheel.");
    add("radius right", In::metres, drive.wheel_radius_right_m, "Rolling radius of the right wheel.");
    add("wheelbase", In::metres, drive.wheelbase_m, "Between the points where the wheels touch the floor.");
  }
  void counts(double& value) const {
    add("counts a turn", In::count, value, "Pulses of the encoder for each turn of its shaft.", false);
  }
};

void list_of(DifferentialDrive& v, const Lister& to) {
  to.wheels(v);
  to.counts(v.encoder_counts_per_revolution);
}

void list_of(SynchroDrive& v, const Lister& to) {
  to.add("wheel radius", In::metres, v.wheel_radius_m, "Rolling radius of all three wheels.");
  to.add("steer ratio", In::ratio, v.steering_ratio, "The steering encoder's angle over that of the wheels.");
  to.add("steer roll", In::ratio, v.wheel_rad_per_steering_rad,
         "Rotation of the wheels for each radian of steering that moves nothing.", false);
  to.add("base turn", In::radians_per_metre, v.base_turn_rad_per_m,
         "By how much the base turns on each metre, though it should not.", false);
  to.add("… cosine", In::radians_per_metre, v.base_turn_cos_rad_per_m,
         "The part of that which goes with the cosine of the wheels' direction: unequal wheels.", false);
  to.add("… sine", In::radians_per_metre, v.base_turn_sin_rad_per_m,
         "The part of that which goes with the sine of the wheels' direction: unequal wheels.", false);
  to.add("drive counts", In::count, v.drive_counts_per_revolution, "Pulses for each turn of the wheels.", false);
  to.add("steer counts", In::count, v.steering_counts_per_revolution, "Pulses for each turn of the turret.", false);
}

void list_of(Tracked& v, const Lister& to) {
  to.add("radius left", In::metres, v.sprocket_radius_left_m,
         "Of the left sprocket, to the middle of the track: its travel for each radian.");
  to.add("radius right", In::metres, v.sprocket_radius_right_m,
         "Of the right sprocket, to the middle of the track: its travel for each radian.");
  to.add("track width", In::metres, v.track_width_m, "Between the tracks' middles.");
  to.add("slip factor", In::ratio, v.slip_factor,
         "How much wider the odometry takes the vehicle to be in turns, because its tracks slip.", false);
  to.counts(v.encoder_counts_per_revolution);
}

void list_of(LinkedTrucks& v, const Lister& to) {
  to.add("link length", In::metres, v.link_length_m, "From axle centre to axle centre in a straight train.");
  to.add("angle A bias", In::radians, v.link_angle_a_offset_rad,
         "Reading minus truth of the rotary encoder on truck A.");
  to.add("angle B bias", In::radians, v.link_angle_b_offset_rad,
         "Reading minus truth of the rotary encoder on truck B.");
  to.add("length bias", In::metres, v.link_length_offset_m, "Reading minus truth of the linear encoder.");
  to.add("angle step", In::radians, v.link_angle_resolution_rad, "Resolution of the rotary encoders.", false);
  to.add("length step", In::metres, v.link_length_resolution_m, "Resolution of the linear encoder.", false);
  to.in("truck A").wheels(v.truck_a);
  to.in("truck B").wheels(v.truck_b);
}

void list_of(EncoderTrailer& v, const Lister& to) {
  to.add("hitch behind", In::metres, v.hitch_offset_m, "From the towing vehicle's centre back to the hitch.");
  to.add("drawbar", In::metres, v.drawbar_length_m, "From the hitch to the trailer's axle.");
  to.add("hitch bias", In::radians, v.hitch_angle_offset_rad, "Reading minus truth of the hitch's encoder.");
  to.add("hitch step", In::radians, v.hitch_angle_resolution_rad, "Resolution of the hitch's encoder.", false);
  to.in("trailer").wheels(v.trailer);
  to.in("tracks").wheels(v.tow);
}

void list_of(SmartEncoderTrailer& v, const Lister& to) {
  to.add("drawbar", In::metres, v.drawbar_length_m, "From the towing vehicle's centre to the trailer's axle.");
  to.add("hitch bias", In::radians, v.hitch_angle_offset_rad, "Reading minus truth of the hitch's encoder.");
  to.add("hitch step", In::radians, v.hitch_angle_resolution_rad, "Resolution of the hitch's encoder.", false);
  to.in("towing vehicle").wheels(v.tow);
  to.in("trailer").wheels(v.trailer);
}

void list_of(MultiCastor& v, const Lister& to) {
  to.add("wheel step", In::radians, v.wheel_encoder_resolution_rad, "Resolution of the wheels' encoders.", false);
  to.add("pivot step", In::radians, v.pivot_encoder_resolution_rad, "Resolution of the pivots' encoders.", false);
  for (std::size_t i = 0; i < v.castors.size(); ++i) {
    Castor& c = v.castors[i];
    const Lister of = to.in("castor " + std::to_string(i + 1));
    of.add("pivot radius", In::metres, c.pivot_radius_m, "R: the pivot's distance from the body's origin.");
    of.add("pivot at", In::radians, c.pivot_angle_rad, "phi: the pivot's direction from the body's x axis.");
    of.add("offset", In::metres, c.offset_m, "r_c: from the axle to the pivot.");
    of.add("radius left", In::metres, c.wheel_radius_left_m, "r_w of the left wheel.");
    of.add("radius right", In::metres, c.wheel_radius_right_m, "r_w of the right wheel.");
    of.add("d left", In::metres, c.wheel_offset_left_m, "d: from the left wheel to the line through the pivot.");
    of.add("d right", In::metres, c.wheel_offset_right_m, "d: from the right wheel to the line through the pivot.");
    of.add("pivot bias", In::radians, c.pivot_encoder_offset_rad, "beta: reading minus truth of the pivot's encoder.");
  }
}

struct Words {
  std::string operator()(const DifferentialDrive&) const { return "differential drive"; }
  std::string operator()(const SynchroDrive&) const { return "synchro drive"; }
  std::string operator()(const Tracked&) const { return "tracked vehicle"; }
  std::string operator()(const Clapper&) const { return "two trucks on a compliant link"; }
  std::string operator()(const OmniMate&) const { return "two trucks under a platform"; }
  std::string operator()(const EncoderTrailer&) const { return "with encoder trailer"; }
  std::string operator()(const SmartEncoderTrailer&) const { return "with smart encoder trailer"; }
  std::string operator()(const MultiCastor& v) const { return std::to_string(v.castors.size()) + " driven castors"; }
};

}  // namespace

std::vector<VehicleParameter> parameters_of(VehicleKind& kind) {
  std::vector<VehicleParameter> list;
  std::visit([&](auto& vehicle) { list_of(vehicle, Lister{&list, ""}); }, kind);
  return list;
}

std::string words_of(const VehicleKind& kind) { return std::visit(Words{}, kind); }

}  // namespace odolab
