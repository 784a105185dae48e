#!/bin/sh
# What Doxygen reads in place of a file. Of a header: its first comment describes the file. Of a page: links to other
# pages, which are no part of the reference, become their names, and links within the page their words. A link's words
# may be on two lines.
case "$1" in
  *.h | *.hpp) sed -e '1s|^// [^:]*: |/// @file\n/// |;t' -e '1,/^#pragma once/s|^//|///|' "$1" ;;
  *) sed -z -e 's|\[\([^]]*\)\](\.\./\([A-Za-z-]*\.md\)[^)]*)|\1 (\2)|g' \
            -e 's|\[\([^]]*\)\](\([A-Za-z-]*\.md\)[^)]*)|\1 (docs/\2)|g' \
            -e 's|\[\([^]]*\)\](#[^)]*)|\1|g' "$1" ;;
esac
