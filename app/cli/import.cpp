#include "app/cli/command.h"
#include "app/cli/terminal.h"
#include "core/io/import/imported_recording.h"
#include "core/io/recording_csv.h"

namespace odolab {

namespace {

struct ImportOptions {
  std::vector<std::string> sources;
  std::string out;
};

int execute(const ImportOptions& options) {
  Result<ImportedRecording> imported = import_recording(options.sources);
  if (!imported) return bad_input(imported.error());
  const Recording& recording = imported->recording;
  if (Result<Done> written = write_recording_csv(options.out, recording); !written) return bad_input(written.error());
  for (const std::string& warning : imported->warnings) print_message("warning: " + warning);
  std::string channels;
  for (const Channel& channel : recording.channels) channels += (channels.empty() ? "" : ", ") + channel.name;
  std::printf("%s: %zu rows over %.1f s, %s\n", options.out.c_str(), recording.time_s.size(), recording.duration_s(),
              channels.c_str());
  return kDone;
}

}  // namespace

Command import_command() {
  const auto options = std::make_shared<ImportOptions>();
  Command command;
  command.name = "import";
  command.about = "Turns a recording in another format into OdoLab's CSV";
  command.example = "odolab import run-01_odo.csv run-01_opti.csv --out run-01.csv";
  command.declare = [options](Arguments& arguments) {
    arguments.files("SOURCE", options->sources, "one run: one file, or the two that belong together", true);
    arguments.option("--out", options->out, "the recording to write (CSV)", true);
  };
  command.execute = [options] { return execute(*options); };
  return command;
}

}  // namespace odolab
