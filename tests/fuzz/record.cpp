// Records of measurements and files of probes: a record comes of a file, or one problem with its
// place, and what its channels mean is found or refused.
//
// The first letter of an input says what it is: c a table, l a file of LabVIEW in text, t a TDMS
// file, u a universal file, w a sound file, p a file of probes of two disks. (HDF5 and MATLAB,
// which others' libraries read, are those of foreign.cpp.)

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include "libbase/error.hpp"
#include "libdata/measured/probe_readings.hpp"
#include "libio/measured/law_file.hpp"
#include "libio/measured/probe_file.hpp"
#include "libio/measured/record_file.hpp"
#include "libio/model/model_file.hpp"
#include "tests/fuzz/scratch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace whirl;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Every channel as a probe, and the last one as a key-phasor.
void use(const MeasuredRecord& record) {
  MeasurementSetup setup;
  for (std::size_t i = 0; i < record.channels.size(); ++i) {
    const std::string& unit = record.channels[i].unit;
    ProbeGain gain;
    if (unit == "V") gain = {ProbeGain::Of::voltage, 7870.0};
    if (unit.empty() || unit == share_of_full_scale) gain = {ProbeGain::Of::number, 1e6};
    setup.probes.push_back({{.name = "probe"}, std::to_string(i + 1), gain});
  }
  try {
    const ProbeReadings readings = probe_readings(record, setup);
    require(readings.displacement.allFinite());
    setup.key_phasor = KeyPhasor{.channel = std::to_string(record.channels.size())};
    const ProbeReadings turned = probe_readings(record, setup);
    require(turned.clock->mean_speed() > 0.0 && turned.clock->variation() >= 0.0);
    turned.clock->angle(0.5 * (turned.clock->first() + turned.clock->last()));
  } catch (const ModelError&) {
  }
}

void read(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  try {
    const MeasuredRecord record = read_record(path);
    require(record.rate > 0.0 && std::isfinite(record.rate) && std::isfinite(record.start));
    require(record.samples.rows() > 0 && std::ssize(record.channels) == record.samples.cols());
    use(record);
  } catch (const ModelError& error) {
    require(!error.problems().empty() && !error.problems().front().message.empty());
  } catch (const FileError&) {
  }
}

/// A response comes of a universal file, too, or what is wrong with it.
void read_response(const fs::path& path) {
  for (const char* part : {"", "1", "1+x"}) {
    const auto found = law_table(path, part, {});
    require(found ? !found->table.text.empty() : !found.problem.empty());
  }
}

void read_probes(const std::string& text) {
  static const Model model = read_model(WHIRL_SOURCE_DIR "/models/two_disk_mac.toml");
  try {
    const MeasurementSetup setup = parse_probe_file(text, "probes.toml", model);
    require(!setup.probes.empty());
    for (const MeasuredProbe& p : setup.probes) {
      require(std::isfinite(p.gain.value) && p.gain.value != 0.0 && p.unit_length > 0.0);
    }
  } catch (const ModelError& error) {
    require(!error.problems().empty() && !error.problems().front().message.empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0]) {
    case 'c':
      read(scratch.folder / "record.csv", text);
      break;
    case 'l':
      read(scratch.folder / "record.lvm", text);
      break;
    case 't':
      read(scratch.folder / "record.tdms", text);
      break;
    case 'u':
      read(scratch.folder / "record.uff", text);
      read_response(scratch.folder / "record.uff");
      break;
    case 'w':
      read(scratch.folder / "record.wav", text);
      break;
    case 'p':
      read_probes(text);
      break;
    default:
      break;
  }
  return 0;
}
