#pragma once

#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "input/recordings/messages/test_messages.hpp"
#include "ros2/node.hpp"

namespace stdc::ros2 {

/// Loopback only, in a domain that hardly another test has. Nodes of one process go by the network too: what
/// Fast DDS does between them otherwise loses messages where a reader has no room, and no robot does it.
inline NodeOptions test_domain() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
  return {.domain = 1 + static_cast<int>(getpid() % 99), .localhost_only = true};
}

/// Waits for what will happen, however slow the machine is.
inline bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

using Style = test::MessageWriter::Style;

}  // namespace stdc::ros2
