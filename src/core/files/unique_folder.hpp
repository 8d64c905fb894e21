#pragma once

#include <filesystem>
#include <system_error>

namespace stdc {

/// Makes an empty folder that only this user may enter, named `stem` and a few characters that make it new.
/// @return its path; empty if `failed` says why there is none
std::filesystem::path make_unique_folder(const std::filesystem::path& stem, std::error_code& failed);

}  // namespace stdc
