#include "core/io/guide_toml.h"

#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

const std::vector<std::string> kGuideSchemas = {"odolab.guide/1"};

std::vector<std::string> guide_keys() {
  std::vector<std::string> keys;
  for (const Guide& guide : guides()) keys.push_back(guide.key);
  return keys;
}

template <typename S, typename Toml>
void session_fields(S& session, Toml& toml) {
  toml.field("real_robot", session.real_robot);
  toml.field("page", session.page);
  toml.field("reached", session.reached);
  toml.field("side_m", session.side_m);
  toml.field("runs_each_way", session.runs_each_way);
}

template <typename S, typename Toml>
void run_fields(S& run, Toml& toml) {
  toml.field("clockwise", run.clockwise);
  toml.field("odometry_x_m", run.odometry.x_m);
  toml.field("odometry_y_m", run.odometry.y_m);
  toml.field("odometry_heading_rad", run.odometry.heading_rad);
  toml.field("measured_x_m", run.measured.x_m);
  toml.field("measured_y_m", run.measured.y_m);
  toml.field("measured_heading_rad", run.measured.heading_rad);
  toml.field("has_heading", run.has_heading);
  toml.field("left_out", run.left_out);
  toml.field("source", run.source);
}

template <typename S, typename Toml>
void guided_drive_fields(S& drive, Toml& toml) {
  toml.field("wheel_radius_left_m", drive.wheel_radius_left_m);
  toml.field("wheel_radius_right_m", drive.wheel_radius_right_m);
  toml.field("wheelbase_m", drive.wheelbase_m);
}

template <typename S, typename Toml>
void tape_fields(S& tape, Toml& toml) {
  toml.field("calculated_m", tape.calculated_m);
  toml.field("actual_m", tape.actual_m);
  toml.field("tape_accuracy_m", tape.tape_accuracy_m);
}

GuideRound read_round(TomlTable& table, const Vehicle& vehicle) {
  GuideRound round;
  if (const auto* drive = std::get_if<DifferentialDrive>(&vehicle.kind)) round.nominal = *drive;  // counts and gear
  guided_drive_fields(round.nominal, table);
  table.field("lost", round.lost);
  for (TomlTable& element : table.tables("run")) run_fields(round.runs.emplace_back(), element);
  return round;
}

void write_round(TomlText& text, const GuideRound& round, const std::string& path) {
  guided_drive_fields(round.nominal, text);
  text.field("lost", round.lost);
  for (const GuideRun& run : round.runs) {
    text.table_element(path + ".run");
    run_fields(run, text);
  }
}

}  // namespace

Result<GuideSession> read_guide_session(const std::string& path) {
  Result<TomlTable> read = TomlTable::read(path);
  if (!read) return read.error();
  TomlTable& top = *read;
  top.require("schema");
  top.index_of_choice("schema", 0, kGuideSchemas);
  GuideSession session;
  top.require("guide");
  top.choice("guide", session.kind, guide_keys());
  session_fields(session, top);
  TomlTable vehicle = top.table("vehicle");
  session.vehicle = vehicle_from(vehicle, "vehicle.");
  if (TomlTable tape = top.table("tape"); tape.present()) tape_fields(session.tape.emplace(), tape);
  TomlTable draft = top.table("draft");
  run_fields(session.draft, draft);
  for (TomlTable& element : top.tables("round")) session.rounds.push_back(read_round(element, session.vehicle));
  TomlTable bumped = top.table("bumped");
  session.bumped = read_round(bumped, session.vehicle);
  for (TomlTable& element : top.tables("recording")) element.field("file", session.recordings.emplace_back());
  for (TomlTable& element : top.tables("held_out")) element.field("file", session.held_out.emplace_back());
  const Result<Done> done = top.finish();
  if (!done) return done.error();
  for (const std::string& problem : problems_in(session)) return top.error_of(problem);
  return session;
}

Result<Done> write_guide_session(const std::string& path, const GuideSession& session) {
  TomlText text;
  text.field("schema", kGuideSchemas.front());
  text.field("guide", guide_of(session.kind).key);
  session_fields(session, text);
  text.table("vehicle");
  write_vehicle_to(text, session.vehicle, "vehicle.");
  if (session.tape) {
    text.table("tape");
    tape_fields(*session.tape, text);
  }
  text.table("draft");
  run_fields(session.draft, text);
  for (const GuideRound& round : session.rounds) {
    text.table_element("round");
    write_round(text, round, "round");
  }
  text.table("bumped");
  write_round(text, session.bumped, "bumped");
  for (const std::string& file : session.recordings) {
    text.table_element("recording");
    text.field("file", file);
  }
  for (const std::string& file : session.held_out) {
    text.table_element("held_out");
    text.field("file", file);
  }
  return write_whole_file_durably(path, text.text());
}

}  // namespace odolab
