#include "libio/results/branch_ends.hpp"

#include "libio/results/hdf5.hpp"

namespace whirl::inline io {

void write_ends(ResultWriter& file, const std::string& group, const std::string& axis,
                const std::vector<std::optional<BranchEnd>>& ends) {
  std::vector<std::string> texts, kinds, reasons;
  for (const auto& end : ends) {
    texts.push_back(end ? end->text : "");
    kinds.emplace_back(end ? name_of(end->kind) : "");
    reasons.push_back(end ? end->reason : "");
  }
  const std::vector<std::string> axes{axis};
  file.dataset(group + "/end", texts, {"", "why it ends", axes});
  file.dataset(group + "/end_kind", kinds, {"", "what makes it end", axes});
  file.dataset(group + "/end_reason", reasons, {"", "what fails where no orbit is found", axes});
}

std::vector<std::optional<BranchEnd>> read_ends(const ResultReader& file,
                                                const std::string& group) {
  const std::vector<std::string> texts = file.strings(group + "/end");
  std::vector<std::string> kinds(texts.size()), reasons = kinds;
  if (file.has(group + "/end_kind")) kinds = file.strings(group + "/end_kind");
  if (file.has(group + "/end_reason")) reasons = file.strings(group + "/end_reason");
  std::vector<std::optional<BranchEnd>> ends(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;
    ends[i] = {.kind = EndKind::untold, .text = texts[i], .reason = reasons[i]};
    for (const auto& [name, kind] : choices(EndKind{})) {
      if (kinds[i] == name) ends[i]->kind = kind;
    }
  }
  return ends;
}

}  // namespace whirl::inline io
