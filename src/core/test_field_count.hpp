#pragma once

#include <cstddef>

namespace stdc::test {

/// Stands for an initialiser of any type.
struct AnyValue {
  template <typename T>
  operator T() const;  // NOLINT: it has to be implicit, and is never called
};

/// How many fields an aggregate has: the most initialisers that it takes.
template <typename Aggregate, typename... Values>
constexpr std::size_t field_count() {
  if constexpr (requires { Aggregate{Values()..., AnyValue()}; }) {
    return field_count<Aggregate, Values..., AnyValue>();
  } else {
    return sizeof...(Values);
  }
}

}  // namespace stdc::test
