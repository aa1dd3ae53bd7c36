#include <algorithm>

#include "app/cli/command.h"
#include "app/cli/overwriting.h"
#include "app/cli/terminal.h"
#include "core/io/bag/bag.h"
#include "core/io/import/imported_recording.h"
#include "core/io/import/numbered_otherwise.h"

namespace odolab {

namespace {

struct ImportOptions {
  std::vector<std::string> sources;
  std::string out, joints, axes, mapping, delimiter;
  std::vector<std::string> columns;
  double period_s = 0.0;
  bool list = false;
  ImportWishes wishes;
};

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// What stands in each bag: topics, and what a person would name of them.
int list(const std::vector<std::string>& sources) {
  for (const std::string& source : sources) {
    if (!is_bag(source)) return bad_input({source, "no ROS 2 bag", "one: only bags have something to list"});
    const Result<BagContents> contents = contents_of_bag(source, terminal_progress("import"));
    if (!contents) return bad_input(contents.error());
    if (sources.size() > 1) std::printf("%s\n", source.c_str());
    std::vector<std::vector<std::string>> rows{{"topic", "messages", "seconds", "type"}};
    for (const BagTopicContents& topic : contents->topics) {
      const double seconds = static_cast<double>(topic.last_ns - topic.first_ns) * 1e-9;
      rows.push_back({topic.topic.name, std::to_string(topic.messages), text_of("%.1f", seconds),
                      topic.topic.type + (topic.topic.encoding == "cdr" ? "" : " (" + topic.topic.encoding + ")")});
    }
    print_table(rows);
    for (const BagTopicContents& topic : contents->topics) {
      if (!topic.joints.empty())
        std::printf("joints of %s: %s\n", topic.topic.name.c_str(), joined(topic.joints).c_str());
      for (const BagTransform& t : topic.transforms)
        std::printf("transform: %s:%s:%s\n", topic.topic.name.c_str(), t.parent.c_str(), t.child.c_str());
    }
    for (const std::string& sentence : contents->damage) print_message("warning: " + sentence);
  }
  return kDone;
}

std::optional<Error> read_words(ImportOptions& options) {
  if (!options.joints.empty()) {
    const std::size_t comma = options.joints.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == options.joints.size())
      return Error{"--joints", "'" + options.joints + "'", "the left and the right wheel's joint, LEFT,RIGHT"};
    options.wishes.left_joint = options.joints.substr(0, comma);
    options.wishes.right_joint = options.joints.substr(comma + 1);
  }
  if (options.axes == "y_up")
    options.wishes.axes = SpaceAxes::y_up;
  else if (options.axes == "camera")
    options.wishes.axes = SpaceAxes::camera;
  else if (options.axes == "z_up")
    options.wishes.axes = SpaceAxes::z_up;
  else if (!options.axes.empty())
    return Error{"--axes", "'" + options.axes + "'", "z_up, y_up or camera"};
  TextMapping& mapping = options.wishes.mapping;
  if (!options.mapping.empty()) {
    Result<TextMapping> read = read_text_mapping(options.mapping);
    if (!read) return read.error();
    mapping = std::move(*read);
  }
  for (const std::string& words : options.columns)
    if (auto error = add_column(mapping, words)) return error;
  if (!options.delimiter.empty()) {
    const std::optional<char> delimiter = delimiter_of(options.delimiter);
    if (!delimiter) return Error{"--delimiter", "'" + options.delimiter + "'", "comma, semicolon, tab or blank"};
    mapping.shape.delimiter = *delimiter;
  }
  if (!options.delimiter.empty() && mapping.columns.empty())
    return Error{"--delimiter", "no --map beside it", "time_s=COLUMN and others: what the columns of such text become"};
  if (options.period_s > 0.0) mapping.period_s = options.period_s;
  if (options.period_s < 0.0) return Error{"--period", text_of("%g", options.period_s), "seconds above 0"};
  return std::nullopt;
}

int execute_import(ImportOptions& options) {
  if (options.list) return list(options.sources);
  if (options.out.empty()) return bad_input({"import", "no --out", "--out with the recording to write, or --list"});
  std::vector<std::string> inputs = options.sources;
  inputs.insert(inputs.end(), {options.mapping, options.wishes.times});
  if (const std::optional<Error> unusable = unusable_output({options.out}, inputs)) return bad_input(*unusable);
  if (const auto error = read_words(options)) return bad_input(*error);
  const Result<ImportedFile> imported =
      import_into_csv(options.sources, options.wishes, options.out, terminal_progress("import"));
  if (!imported) return bad_input(imported.error());
  for (const std::string& warning : imported->warnings) print_message("warning: " + warning);
  if (const auto of_two_runs = numbered_otherwise(options.sources)) print_message("warning: " + *of_two_runs);
  std::printf("%s: %llu rows over %.1f s, %s\n", name_of_output(options.out).c_str(),
              static_cast<unsigned long long>(imported->rows), imported->duration_s,
              joined(imported->channels).c_str());
  return kDone;
}

}  // namespace

Command import_command() {
  const auto options = std::make_shared<ImportOptions>();
  Command command;
  command.name = "import";
  command.about = "Turns a recording in another format into OdoLab's CSV: ROS 2 bags, text, other people's data sets";
  command.example =
      "odolab import --list my_bag\n"
      "  odolab import my_bag --truth /mocap/robot/pose --joints left_wheel_joint,right_wheel_joint --out run.csv\n"
      "  odolab import log.csv truth.tum --map time_s=t,ms left_wheel_rad=enc_l,deg right_wheel_rad=-enc_r,deg --out "
      "run.csv\n"
      "  odolab import run-01_odo.csv run-01_opti.csv --out run-01.csv";
  command.declare = [options](Arguments& arguments) {
    arguments.files("SOURCE", options->sources, "one run: a file, a bag's folder, or the files that belong together",
                    true);
    arguments.output("--out", options->out, "the recording to write (CSV)");
    arguments.flag("--list", options->list, "only say what a bag holds: topics, joints, transforms");
    arguments.option("--wheels", options->wishes.wheels, "bags: the topic of the wheels' joint states");
    arguments.option("--joints", options->joints, "bags: the joints of the drive wheels, LEFT,RIGHT");
    arguments.option("--commands", options->wishes.commands, "bags: the topic of commanded twists, or none");
    arguments.option(
        "--truth", options->wishes.truth,
        "bags: the topic of the outside truth, for transforms TOPIC:PARENT:CHILD (frames may lie between), or none");
    arguments.files(
        "--map", options->columns,
        "text: what columns become, CHANNEL=COLUMN[,UNIT][,rate or increment][,FACTOR]; a minus before the "
        "column turns its sign. Beside a recording's columns truth_qx, truth_qy, truth_qz, truth_qw make the "
        "heading of a quaternion, and time_s=header.stamp adds ROS's seconds and nanoseconds",
        false);
    arguments.option("--mapping", options->mapping, "text: the same in a file (TOML), with delimiter and comment");
    arguments.option("--delimiter", options->delimiter, "text: comma, semicolon, tab or blank, where it is not plain");
    arguments.option("--period", options->period_s, "text: seconds between rows, where no column has the time");
    arguments.option("--times", options->wishes.times, "KITTI poses: the file with their times");
    arguments.option("--axes", options->axes, "how poses in space lie: z_up (the default), y_up, camera");
  };
  command.execute = [options] { return execute_import(*options); };
  return command;
}

}  // namespace odolab
