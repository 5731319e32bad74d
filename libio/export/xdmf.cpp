#include "libio/export/xdmf.hpp"

#include <fmt/format.h>

#include <cassert>
#include <set>
#include <utility>

#include "libio/results/hdf5.hpp"
#include "libio/results/own_file.hpp"
#include "libio/results/replace_file.hpp"
#include "libio/text/xml.hpp"

namespace whirl::inline io {

namespace fs = std::filesystem;

namespace {

/// A dataset in the HDF5 file, as XDMF names it.
std::string item(const std::string& file, const std::string& path, const std::string& size,
                 bool is_integer = false) {
  return fmt::format(
      "<DataItem DataType=\"{}\" Precision=\"{}\" Dimensions=\"{}\" "
      "Format=\"HDF\">{}:{}</DataItem>",
      is_integer ? "Int" : "Float", is_integer ? 4 : 8, size, file, path);
}

std::string attribute(const std::string& name, const std::string& type, const std::string& data) {
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name,
      type, data);
}

}  // namespace

std::vector<fs::path> write_xdmf_series(const fs::path& xdmf_path, const VtkScene& scene,
                                        const std::vector<VtkFrame>& frames, Replaces replaces) {
  const fs::path old = FileReplacement{xdmf_path, replaces}.place();
  const fs::path numbers =
      fs::path(xdmf_path).replace_filename(xdmf_path.stem().string() + "_xdmf.h5");
  const Replaces of_numbers = replaces == Replaces::anything ? replaces : Replaces::own_results;
  FileReplacement{numbers, of_numbers};
  std::error_code ignored;
  fs::remove(old, ignored);  // which tells of other numbers
  const std::string name = xml_text(numbers.filename().string());
  const auto points = std::ssize(scene.z);

  Mat rest = Mat::Zero(points, 3);
  Vec radius = Vec::Zero(points);
  for (Eigen::Index i = 0; i < points; ++i) rest(i, 2) = scene.z[static_cast<std::size_t>(i)];
  std::vector<int> lines;
  std::set<std::pair<int, int>> drawn;
  for (const VtkShaftPiece& piece : scene.shaft) {
    const bool is_layer =
        !drawn.insert({piece.left, piece.right}).second;  // on a line that is there
    if (!is_layer) lines.insert(lines.end(), {piece.left, piece.right});
    radius(piece.left) = std::max(radius(piece.left), piece.left_radius);
    radius(piece.right) = std::max(radius(piece.right), piece.right_radius);
  }
  const bool has_shaft = !lines.empty();
  if (!has_shaft) {
    for (int i = 0; i < points; ++i) lines.push_back(i);
  }
  const Eigen::Index corners = has_shaft ? 2 : 1;
  const Eigen::Index cells = std::ssize(lines) / corners;

  ResultWriter file(numbers, of_numbers);
  file.attribute("/", "program", std::string(json_mark));
  file.dataset("/points", rest, {"m", "points at rest", {}});
  file.dataset("/radius", radius, {"m", "radius of the shaft", {}});
  file.dataset("/lines", lines, {cells, corners}, {"", "points of the lines", {}});
  const std::string size = fmt::format("{}", points), size_3 = fmt::format("{} 3", points);
  const std::string grid = fmt::format(
      "        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">{}"
      "</Topology>\n        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
      has_shaft ? "Polyline" : "Polyvertex", cells, corners,
      item(name, "/lines", fmt::format("{} {}", cells, corners), true),
      item(name, "/points", size_3));
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n{}\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"motion\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      xml_mark);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const VtkFrame& frame = frames[k];
    assert(frame.motion.rows() == points && frame.forces.size() == scene.contacts.size());
    Mat displacement = Mat::Zero(points, 3), rotation = displacement, force = displacement;
    displacement.leftCols(2) = frame.motion.leftCols(2);
    rotation.leftCols(2) = frame.motion.rightCols(2);
    for (std::size_t i = 0; i < frame.forces.size(); ++i) {
      force.row(scene.contacts[i].point).head(2) += frame.forces[i].force.transpose();
    }
    const std::string group = fmt::format("/frame_{:06}", k + 1);
    file.dataset(group + "/displacement", displacement, {"m", "displacement", {}});
    file.dataset(group + "/rotation", rotation, {"rad", "rotation", {}});
    file.dataset(group + "/force", force, {"N", "contact force", {}});
    text += fmt::format(
        "      <Grid Name=\"frame {}\" GridType=\"Uniform\">\n"
        "        <Time Value=\"{}\"/>\n{}",
        k + 1, frame.time, grid);
    text += attribute("displacement [m]", "Vector", item(name, group + "/displacement", size_3));
    text += attribute("rotation [rad]", "Vector", item(name, group + "/rotation", size_3));
    text += attribute("contact force [N]", "Vector", item(name, group + "/force", size_3));
    text += attribute("radius [m]", "Scalar", item(name, "/radius", size));
    text += "      </Grid>\n";
  }
  file.commit();
  replace_file(xdmf_path, text + "    </Grid>\n  </Domain>\n</Xdmf>\n", replaces);
  return {xdmf_path, numbers};
}

}  // namespace whirl::inline io
