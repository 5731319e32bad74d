#include "libio/import/parse_json.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <unordered_map>

namespace whirl::inline io {

namespace {

constexpr std::size_t most_nested = 32;  ///< lists and tables within one another

/// Goes through a text and counts its lines.
class Counted {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Counted(const char* at, int* line) : at_(at), line_(line) {}
  reference operator*() const { return *at_; }
  Counted& operator++() {
    if (*at_++ == '\n') ++*line_;
    return *this;
  }
  Counted operator++(int) {
    Counted before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Counted& other) const { return at_ == other.at_; }
  bool operator!=(const Counted& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  int* line_;
};

/// Builds the tree from what the parser tells, value by value.
class Builder {
 public:
  Builder(const std::string& file, const int& line) : file_(file), line_(line) {}
  ConfigNode take() { return std::move(root_); }

  bool null() { return add(node(ConfigNode::Kind::other)); }
  bool boolean(bool value) {
    ConfigNode n = node(ConfigNode::Kind::boolean);
    n.boolean = value;
    return add(std::move(n));
  }
  bool number_integer(long long value) { return number(static_cast<double>(value), true); }
  bool number_unsigned(unsigned long long value) {
    return number(static_cast<double>(value), true);
  }
  bool number_float(double value, const std::string&) { return number(value, false); }
  bool string(std::string& value) {
    ConfigNode n = node(ConfigNode::Kind::string);
    n.text = value;
    return add(std::move(n));
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }
  bool start_object(std::size_t) { return open(ConfigNode::Kind::table); }
  bool start_array(std::size_t) { return open(ConfigNode::Kind::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& name) {
    const auto [first, is_new] = seen_.back().try_emplace(name, line_);
    if (!is_new) {
      throw ModelError(
          here(), name,
          fmt::format("this key is there already, in line {}; expected it once", first->second));
    }
    keys_.back() = {name, here()};
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) {
    const std::string what = error.what();
    const auto overflow = what.find("number overflow parsing ");
    if (overflow != std::string::npos) {
      throw ModelError(here(), "",
                       fmt::format("found {}, expected a number of less than 1.8e308",
                                   what.substr(what.find('\'', overflow))));
    }
    const auto colon = what.find("syntax error");
    throw ModelError(here(), "",
                     "not JSON: " + (colon == std::string::npos ? what : what.substr(colon)));
  }

 private:
  Where here() const { return {file_, line_, 1}; }
  ConfigNode node(ConfigNode::Kind kind) const {
    ConfigNode n;
    n.kind = kind;
    n.where = here();
    return n;
  }
  bool number(double value, bool is_whole) {
    ConfigNode n = node(is_whole ? ConfigNode::Kind::integer : ConfigNode::Kind::real);
    n.number = value;
    return add(std::move(n));
  }
  /// Puts a value where it belongs: at the end of the list or table that is open.
  bool add(ConfigNode value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return true;
    }
    ConfigNode& in = open_.back();
    if (in.kind == ConfigNode::Kind::array) {
      in.items.push_back(std::move(value));
    } else {
      value.key_where = keys_.back().second;
      in.entries.push_back({keys_.back().first, std::move(value)});
    }
    return true;
  }
  bool open(ConfigNode::Kind kind) {
    if (open_.size() == most_nested) {
      throw ModelError(here(), "", "more than 32 tables or lists within one another");
    }
    open_.push_back(node(kind));
    keys_.emplace_back();
    seen_.emplace_back();
    return true;
  }
  bool close() {
    ConfigNode done = std::move(open_.back());
    open_.pop_back();
    keys_.pop_back();
    seen_.pop_back();
    return add(std::move(done));
  }

  const std::string& file_;
  const int& line_;
  ConfigNode root_;
  std::vector<ConfigNode> open_;
  std::vector<std::pair<std::string, Where>> keys_;  ///< of the open tables: where a value goes
  std::vector<std::unordered_map<std::string, int>> seen_;  ///< lines of the keys of each of them
};

}  // namespace

ConfigNode parse_json(const std::string& text, const std::string& file) {
  int line = 1;
  Builder builder(file, line);
  const char* begin = text.data();
  nlohmann::json::sax_parse(Counted(begin, &line), Counted(begin + text.size(), &line), &builder);
  return builder.take();
}

}  // namespace whirl::inline io
