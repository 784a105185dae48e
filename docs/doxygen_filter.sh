#!/bin/sh
# What Doxygen reads in place of a file. Of a header: its first comment describes the file. Of a page: links to other
# pages, which are no part of the reference, become their names.
case "$1" in
  *.h) sed -e '1s|^// [^:]*: |/// @file\n/// |;t' -e '1,/^#pragma once/s|^//|///|' "$1" ;;
  *) sed -e 's|\[\([^]]*\)\](\.\./\([A-Za-z-]*\.md\)[^)]*)|\1 (\2)|g' \
         -e 's|\[\([^]]*\)\](\([A-Za-z-]*\.md\)[^)]*)|\1 (docs/\2)|g' "$1" ;;
esac
