// std::sort() in a tenth of the code, for the module for JavaScript: libc++'s inlines networks of three, four
// and five elements, with their copies, into every use, which took a tenth of the whole module. Comes before
// libc++'s own header of that name (preset "npm"), which it includes for all else that is in it.
#pragma once

#include <__config>
#include <__algorithm/comp.h>
#include <__algorithm/comp_ref_type.h>
#include <__algorithm/min_element.h>
#include <__algorithm/partial_sort.h>
#include <__algorithm/unwrap_iter.h>
#include <__utility/swap.h>
#include <memory>
#include <type_traits>

#define sort sort_of_libcxx
#include_next <__algorithm/sort.h>
#undef sort

namespace foretouch_small {

/// Elements that are larger are swapped by a call.
constexpr unsigned long kLargestInPlace = 16;
/// Of so many, insertion is quickest.
constexpr int kFew = 12;

template <class T>
[[gnu::noinline]] void swapLarge(T& a, T& b) {
  T kept(static_cast<T&&>(a));
  a = static_cast<T&&>(b);
  b = static_cast<T&&>(kept);
}
template <class T>
inline void exchange(T& a, T& b) {
  if constexpr (sizeof(T) > kLargestInPlace) {
    swapLarge(a, b);
  } else {
    T kept(static_cast<T&&>(a));
    a = static_cast<T&&>(b);
    b = static_cast<T&&>(kept);
  }
}

template <class It, class Less>
[[gnu::noinline]] void sink(It first, long at, long count, Less& less) {
  for (long child = 2 * at + 1; child < count; child = 2 * at + 1) {
    if (child + 1 < count && less(first[child], first[child + 1])) ++child;
    if (!less(first[at], first[child])) return;
    exchange(first[at], first[child]);
    at = child;
  }
}

/// Quick, by heaps where it meets its worst case, and by insertion at the end.
template <class It, class Less>
[[gnu::noinline]] void sortRange(It first, It last, Less& less, int depth) {
  while (last - first > kFew) {
    if (depth-- == 0) {
      const long count = last - first;
      for (long at = count / 2; at-- > 0;) sink(first, at, count, less);
      for (long left = count; left-- > 1;) {
        exchange(first[0], first[left]);
        sink(first, 0, left, less);
      }
      return;
    }
    // The middle one of three goes to the front.
    It middle = first + (last - first) / 2, end = last - 1;
    if (less(*middle, *first)) exchange(*middle, *first);
    if (less(*end, *middle)) exchange(*end, *middle);
    if (less(*middle, *first)) exchange(*middle, *first);
    exchange(*first, *middle);
    It low = first, high = last;
    for (;;) {
      do {
        ++low;
      } while (low < last && less(*low, *first));
      do {
        --high;
      } while (less(*first, *high));
      if (!(low < high)) break;
      exchange(*low, *high);
    }
    exchange(*first, *high);
    if (high - first < last - high) {  // the shorter side by recursion: no deeper than a logarithm
      sortRange(first, high, less, depth);
      first = high + 1;
    } else {
      sortRange(high + 1, last, less, depth);
      last = high;
    }
  }
  if (first == last) return;
  for (It next = first + 1; next != last; ++next) {
    for (It at = next; at != first && less(*at, *(at - 1)); --at) exchange(*at, *(at - 1));
  }
}

}  // namespace foretouch_small

_LIBCPP_BEGIN_NAMESPACE_STD
template <class It, class Less>
inline void sort(It first, It last, Less less) {
  const auto begin = _VSTD::__unwrap_iter(first), end = _VSTD::__unwrap_iter(last);
  int depth = 2;
  for (auto count = end - begin; count > 1; count /= 2) depth += 2;
  foretouch_small::sortRange(begin, end, less, depth);
}
template <class It>
inline void sort(It first, It last) {
  _VSTD::sort(first, last, __less<typename iterator_traits<It>::value_type>());
}
_LIBCPP_END_NAMESPACE_STD
