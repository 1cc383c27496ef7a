// Result<T>: a value, or an Error that names the input and the remedy.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "engine/core/check.h"

namespace palace {

/// What the caller can do about an error.
enum class ErrorCode {
  kUsage,        ///< the operator asked for something impossible; exit code 2
  kInvalid,      ///< the content of a file, message or setting is wrong; exit code 1
  kUnavailable,  ///< a device, file or display is not there; exit code 1
  kEnd,          ///< a stream came to its end; not a failure
};

/// `message` names the file, line, key, value and limit where there is one, and what to do.
struct Error {
  ErrorCode code = ErrorCode::kInvalid;
  std::string message;
};

/// Value or error. Nothing throws across a room: functions that read the outside world return this.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    PALACE_CHECK(ok(), error_text());
    return std::get<0>(content_);
  }
  T& value() & {
    PALACE_CHECK(ok(), error_text());
    return std::get<0>(content_);
  }
  T&& value() && {
    PALACE_CHECK(ok(), error_text());
    return std::get<0>(std::move(content_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

  const Error& error() const {
    PALACE_CHECK(!ok());
    return std::get<1>(content_);
  }

 private:
  std::string error_text() const { return ok() ? std::string() : std::get<1>(content_).message; }
  std::variant<T, Error> content_;
};

/// Success without a value.
struct Done {};
using Status = Result<Done>;
inline Status Ok() { return Done{}; }

inline Error UsageError(std::string message) { return {ErrorCode::kUsage, std::move(message)}; }
inline Error InvalidError(std::string message) { return {ErrorCode::kInvalid, std::move(message)}; }
inline Error UnavailableError(std::string message) {
  return {ErrorCode::kUnavailable, std::move(message)};
}

}  // namespace palace
