#pragma once
/// A house's own page around a printed report.

#include <map>
#include <string>
#include <string_view>

namespace whirl::inline io {

/// What places of a template stand for: "{{title}}" for the value of "title".
struct TemplateValues {
  std::map<std::string, std::string, std::less<>> texts;   ///< plain; empty: nobody said it
  std::map<std::string, std::string, std::less<>> blocks;  ///< HTML
};

/// A template with its places filled, without anything that runs or comes from the network.
///
/// Scripts of the template stay in it and are not run: a content security policy in front forbids
/// them, and everything that is not a file of this machine.
///
/// @param page  HTML; {{style}}, {{verdict}} and {{report}} must be in it
/// @param name  of its file, for messages and for the files that stand beside it; empty: the
///              program's own template, in which texts that nobody said are left empty
/// @throws FileError  with the line: a place that is not known, is not closed, or stands for a text
///                    that nobody said; a place that is missing
std::string filled_template(std::string_view page, const std::string& name,
                            const TemplateValues& values);

}  // namespace whirl::inline io
