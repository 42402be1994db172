// SPDX-License-Identifier: Apache-2.0
#include "rave/script/value.hpp"

#include <bit>
#include <cstring>
#include <optional>
#include <ostream>

namespace rave::script {
namespace {

/// The kinds in bytes; part of the form, so they must not change.
enum class Kind : std::uint8_t { kNil, kFalse, kTrue, kWhole, kReal, kText, kTable };

void put(std::vector<std::byte>& out, std::uint64_t number) {
  for (int i = 0; i < 8; ++i) out.push_back(static_cast<std::byte>(number >> (8 * i)));
}
void put(std::vector<std::byte>& out, Kind kind) { out.push_back(static_cast<std::byte>(kind)); }
void put(std::vector<std::byte>& out, const std::string& text) {
  put(out, std::uint64_t{text.size()});
  const auto bytes = std::as_bytes(std::span(text));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

void put(std::vector<std::byte>& out, const Value& value);

struct Put {
  std::vector<std::byte>& out;
  void operator()(std::monostate) const { put(out, Kind::kNil); }
  void operator()(bool truth) const { put(out, truth ? Kind::kTrue : Kind::kFalse); }
  void operator()(std::int64_t whole) const {
    put(out, Kind::kWhole);
    put(out, static_cast<std::uint64_t>(whole));
  }
  void operator()(double real) const {
    put(out, Kind::kReal);
    put(out, std::bit_cast<std::uint64_t>(real));
  }
  void operator()(const std::string& text) const {
    put(out, Kind::kText);
    put(out, text);
  }
  void operator()(const Value::Table& table) const {
    put(out, Kind::kTable);
    put(out, std::uint64_t{table.size()});
    for (const Value::Entry& entry : table) {
      std::visit(*this, entry.key);
      put(out, entry.value);
    }
  }
};

void put(std::vector<std::byte>& out, const Value& value) { std::visit(Put{out}, value.is); }

class Reader {
 public:
  explicit Reader(std::span<const std::byte> left) : left_(left) {}

  std::optional<Value> value(int depth) {
    const auto kind = this->kind();
    if (!kind) return std::nullopt;
    switch (*kind) {
      case Kind::kNil:
        return Value();
      case Kind::kFalse:
      case Kind::kTrue:
        return Value(*kind == Kind::kTrue);
      case Kind::kWhole:
        return whole<Value>();
      case Kind::kReal:
        if (const auto bits = number()) return Value(std::bit_cast<double>(*bits));
        return std::nullopt;
      case Kind::kText:
        return text<Value>();
      case Kind::kTable:
        return depth < kMaxValueDepth ? table(depth + 1) : std::nullopt;
    }
    return std::nullopt;
  }
  [[nodiscard]] bool empty() const noexcept { return left_.empty(); }

 private:
  std::optional<Kind> kind() {
    if (left_.empty() || left_[0] > static_cast<std::byte>(Kind::kTable)) return std::nullopt;
    const auto kind = static_cast<Kind>(left_[0]);
    left_ = left_.subspan(1);
    return kind;
  }
  std::optional<std::uint64_t> number() {
    if (left_.size() < 8) return std::nullopt;
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      number |= static_cast<std::uint64_t>(left_[i]) << (8 * i);
    }
    left_ = left_.subspan(8);
    return number;
  }
  template <class To>
  std::optional<To> whole() {
    if (const auto bits = number()) return To(static_cast<std::int64_t>(*bits));
    return std::nullopt;
  }
  template <class To>
  std::optional<To> text() {
    const auto size = number();
    if (!size || *size > left_.size()) return std::nullopt;
    std::string text(*size, '\0');
    if (*size > 0) std::memcpy(text.data(), left_.data(), *size);
    left_ = left_.subspan(*size);
    return To(std::move(text));
  }
  std::optional<Value::Key> key() {
    const auto kind = this->kind();
    if (kind == Kind::kWhole) return whole<Value::Key>();
    if (kind == Kind::kText) return text<Value::Key>();
    return std::nullopt;
  }
  std::optional<Value> table(int depth) {
    const auto size = number();
    // Each entry has two bytes at least: a wrong number must not reserve memory.
    if (!size || *size > left_.size() / 2) return std::nullopt;
    Value::Table table;
    for (std::uint64_t i = 0; i < *size; ++i) {
      auto key = this->key();
      if (!key || (!table.empty() && !(table.back().key < *key))) return std::nullopt;
      auto one = value(depth);
      if (!one || one->is_nil()) return std::nullopt;
      table.push_back({*std::move(key), *std::move(one)});
    }
    return Value(std::move(table));
  }

  std::span<const std::byte> left_;
};

template <class Of, class Key>
const Value* find_in(const Value::Table* table, const Key& key) noexcept {
  if (table == nullptr) return nullptr;
  for (const Value::Entry& entry : *table) {
    const Of* const its = std::get_if<Of>(&entry.key);
    if (its != nullptr && *its == key) return &entry.value;
  }
  return nullptr;
}

}  // namespace

Value::Value(Table table) : is(std::move(table)) {}

bool operator==(const Value& a, const Value& b) noexcept {
  // Numbers by their bits: NaN is the same value again, and zero has two signs.
  const auto* const real = std::get_if<double>(&a.is);
  const auto* const other = std::get_if<double>(&b.is);
  if (real != nullptr && other != nullptr) {
    return std::bit_cast<std::uint64_t>(*real) == std::bit_cast<std::uint64_t>(*other);
  }
  return a.is == b.is;
}

bool Value::holds() const noexcept {
  const bool* const truth = std::get_if<bool>(&is);
  return !is_nil() && (truth == nullptr || *truth);
}

double Value::number_or(double otherwise) const noexcept {
  if (const double* const real = std::get_if<double>(&is)) return *real;
  if (const auto* const whole = std::get_if<std::int64_t>(&is)) return static_cast<double>(*whole);
  return otherwise;
}

const Value* Value::find(std::string_view key) const noexcept {
  return find_in<std::string>(table(), key);
}
const Value* Value::find(std::int64_t key) const noexcept {
  return find_in<std::int64_t>(table(), key);
}

std::string_view kind_text(const Value& value) noexcept {
  switch (value.is.index()) {
    case 0:
      return "nothing";
    case 1:
      return "true or false";
    case 2:
    case 3:
      return "a number";
    case 4:
      return "a text";
    default:
      return "a table";
  }
}

std::string to_text(const Value& value) {
  if (const bool* const truth = std::get_if<bool>(&value.is)) return *truth ? "true" : "false";
  if (const auto* const whole = std::get_if<std::int64_t>(&value.is)) {
    return fmt::format("{}", *whole);
  }
  if (const auto* const real = std::get_if<double>(&value.is)) return fmt::format("{}", *real);
  if (const std::string* const text = value.text()) return "\"" + *text + "\"";
  if (value.is_nil()) return "nil";
  std::string all;
  std::int64_t next = 1;
  for (const auto& [key, entry] : *value.table()) {
    if (!all.empty()) all += ", ";
    const auto* const whole = std::get_if<std::int64_t>(&key);
    if (whole == nullptr) {
      all += std::get<std::string>(key) + " = ";
    } else if (*whole != next++) {
      all += fmt::format("[{}] = ", *whole);
    }
    all += to_text(entry);
  }
  return "{" + all + "}";
}

void PrintTo(const Value& value, std::ostream* out) { *out << to_text(value); }

std::vector<std::byte> write_value(const Value& value) {
  std::vector<std::byte> out;
  put(out, value);
  return out;
}

Result<Value> read_value(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  auto value = reader.value(0);
  if (!value || !reader.empty()) {
    return fail(ErrorCode::kParse, "the bytes are no value of a script");
  }
  return *std::move(value);
}

}  // namespace rave::script
