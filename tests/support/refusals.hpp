// What an action that must fail says.
#pragma once

#include <string>

#include "io/error.hpp"

/// The message of a failure, "usage: " and the message of a usage_error, or "no exception".
template <class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const bitshade::failure& e) {
    return e.what();
  } catch (const bitshade::usage_error& e) {
    return std::string("usage: ").append(e.what());
  }
  return "no exception";
}

inline bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
