#include "libio/model/model_file.hpp"

#include "libio/model/file_text.hpp"
#include "libio/model/model_builder.hpp"
#include "libio/text/file_bytes.hpp"

namespace whirl::inline io {

Model parse_model(const std::string& text, const std::string& name,
                  const std::vector<std::string>& sets, const NamedFiles& files) {
  ConfigNode root = parse_toml(text, name);
  const std::string as_read = to_toml(root);
  for (const std::string& set : sets) set_value(root, set);
  ModelBuilder builder(root, files);
  Model model = builder.build();
  for (const FileTable& table : builder.file_tables()) {
    ConfigNode* owner = root.find(table.owner);
    if (owner->kind == ConfigNode::Kind::array) owner = &owner->items[table.item];
    owner->find(table.key)->text = table.text;
  }
  model.path = name;
  // the text as it was, comments and all, where nothing from outside (--set, tables) came into it
  const std::string complete = to_toml(root);
  model.source = complete == as_read ? text : complete;
  return model;
}

std::string file_text(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw ModelError({path.string()}, "", "this is a directory; expected a model file");
  }
  const auto text = file_bytes(path, FileKind::stream, most_text_bytes);
  if (!text) throw ModelError({path.string()}, "", text.problem);
  return *text;
}

Model read_model(const std::filesystem::path& path, const std::vector<std::string>& sets,
                 ConvertFile convert) {
  return parse_model(file_text(path), path.string(), sets,
                     NamedFiles(path.parent_path()).with(convert));
}

void require_speed(const Model& model) {
  if (model.has_speed) return;
  throw ModelError({}, "operation.speed",
                   "missing, expected a speed (rad/s): write [operation] speed = "
                   "\"3000 rpm\", or use --speed 3000rpm");
}

}  // namespace whirl::inline io
