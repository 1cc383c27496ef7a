#include "engine/core/toml_table.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include "engine/core/plain_text.h"
#include "engine/core/text.h"

namespace palace {
namespace {

constexpr std::int64_t kLargestDevice = 255;

int LineOf(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

}  // namespace

TomlTable::TomlTable(const toml::table& root, std::string file, std::string name)
    : file_(std::move(file)), name_(std::move(name)), line_(1) {
  if (const toml::node* node = root.get(name_)) {
    line_ = static_cast<int>(node->source().begin.line);
    table_ = node->as_table();
    if (table_ == nullptr) {
      Fail(line_, "[" + name_ + "] must be a table");
    }
  }
}

TomlTable::TomlTable(std::string file, std::string name, const toml::table& table)
    : file_(std::move(file)), name_(std::move(name)), line_(LineOf(table)), table_(&table) {}

TomlTable TomlTable::OfList(const toml::table& table, std::string file, std::string name) {
  return TomlTable(std::move(file), std::move(name), table);
}

double TomlTable::Number(const char* key, const NumberLimits& limits) {
  const toml::node* node = Required(key);
  return node == nullptr ? 0 : ReadNumber(*node, key, limits);
}
double TomlTable::NumberOr(const char* key, const NumberLimits& limits, double otherwise) {
  return Has(key) ? Number(key, limits) : otherwise;
}

bool TomlTable::BoolOr(const char* key, bool otherwise) {
  if (!Has(key)) {
    return otherwise;
  }
  const toml::node* node = Required(key);
  if (const auto value = node->value_exact<bool>()) {
    return *value;
  }
  Fail(LineOf(*node), Name(key) + " must be true or false");
  return otherwise;
}

std::string TomlTable::Text(const char* key) {
  const toml::node* node = Required(key);
  if (node == nullptr) {
    return {};
  }
  const auto value = node->value_exact<std::string>();
  if (!value || value->empty()) {
    Fail(LineOf(*node), Name(key) + " must be a text in quotes, not empty");
    return {};
  }
  return *value;
}

std::string TomlTable::TextOrIndex(const char* key) {
  const toml::node* node = Required(key);
  if (node == nullptr || !node->is_integer()) {
    return node == nullptr ? std::string() : Text(key);
  }
  const auto index = *node->value<std::int64_t>();
  if (index < 0 || index > kLargestDevice) {
    Fail(LineOf(*node), Name(key) + " = " + std::to_string(index) + " is outside 0 .. " +
                            std::to_string(kLargestDevice) +
                            "; give the number of a device (ls /dev/video*)");
  }
  return std::to_string(index);
}

std::vector<double> TomlTable::Numbers(const char* key, std::size_t least, std::size_t most,
                                       const NumberLimits& limits) {
  const toml::node* node = Required(key);
  if (node == nullptr) {
    return {};
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() < least || array->size() > most) {
    Fail(LineOf(*node), Name(key) + " must be a list of " + std::to_string(least) +
                            (least == most ? "" : " to " + std::to_string(most)) + " numbers");
    return {};
  }
  std::vector<double> numbers;
  for (const toml::node& element : *array) {
    numbers.push_back(ReadNumber(element, key, limits));
  }
  return numbers;
}

void TomlTable::Fail(int line, const std::string& text) {
  if (!error_) {
    error_ = InvalidError(file_ + ":" + std::to_string(line) + ": " + Printable(text));
  }
}
void TomlTable::FailKey(const char* key, const std::string& text) {
  const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
  Fail(node == nullptr ? line_ : LineOf(*node), Name(key) + text);
}

Status TomlTable::Finish() {
  if (!error_ && table_ != nullptr) {
    for (const auto& [key, node] : *table_) {
      if (!asked_.contains(std::string(key.str()))) {
        Fail(LineOf(node), "unknown key " + Name(key.str()) + "; known here: " + Asked());
        break;
      }
    }
  }
  return error_ ? Status(*error_) : Ok();
}

std::string TomlTable::Asked() const {
  std::string text;
  for (const std::string& key : asked_) {
    text += (text.empty() ? "" : ", ") + key;
  }
  return text;
}

const toml::node* TomlTable::Required(const char* key) {
  asked_.insert(key);
  const toml::node* node = table_ == nullptr ? nullptr : table_->get(key);
  if (node == nullptr) {
    Fail(line_, table_ == nullptr ? "table [" + name_ + "] is missing; add it with " + Name(key)
                                  : Name(key) + " is missing; add it to [" + name_ + "]");
  }
  return node;
}

double TomlTable::ReadNumber(const toml::node& node, const char* key, const NumberLimits& limits) {
  const std::optional<double> number = NumberOfToml(node);
  if (!number) {
    Fail(LineOf(node), Name(key) + " must be a number");
    return 0;
  }
  const double value = *number;
  if (!(value >= limits.least && value <= limits.greatest)) {
    Fail(LineOf(node), Name(key) + " = " + NumberText(value) + " is outside " +
                           NumberText(limits.least) + " .. " + NumberText(limits.greatest) + "; " +
                           limits.remedy);
  } else if (limits.whole && value != std::floor(value)) {
    Fail(LineOf(node),
         Name(key) + " = " + NumberText(value) + " must be a whole number; " + limits.remedy);
  }
  return value;
}

}  // namespace palace
