// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/natural_order.h"

#include <cstddef>

namespace icpscape {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// ASCII alone: the order must not hang on the locale.
unsigned char Lower(char c) {
  return static_cast<unsigned char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
}

// Takes the digits that begin at *at, without leading zeros.
std::string TakeNumber(const std::string& text, std::size_t* at) {
  std::string digits;
  for (; *at < text.size() && IsDigit(text[*at]); ++*at) {
    if (!digits.empty() || text[*at] != '0') {
      digits += text[*at];
    }
  }
  return digits;
}

}  // namespace

bool ComesBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string m = TakeNumber(a, &i), n = TakeNumber(b, &j);
      if (m != n) {
        return m.size() != n.size() ? m.size() < n.size() : m < n;
      }
    } else {
      const unsigned char c = Lower(a[i++]), d = Lower(b[j++]);
      if (c != d) {
        return c < d;
      }
    }
  }
  if (i < a.size() || j < b.size()) {
    return i == a.size();
  }
  return a < b;
}

}  // namespace icpscape
