#!/usr/bin/env bash
# image.sh ARCHIVE VERSION OUTPUT: an OCI image of the archive with nothing else in it, as one file, by
# buildah. The same archive gives the same bytes: all dates are SOURCE_DATE_EPOCH.
set -euo pipefail
archive=$1 version=$2 output=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$(dirname "$0")/empty_root.sh" "$archive" "$scratch/root"
find "$scratch/root" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
tools=(--root "$scratch/storage" --runroot "$scratch/run" --storage-driver vfs)
container=$(buildah "${tools[@]}" from scratch)
buildah "${tools[@]}" copy --quiet "$container" "$scratch/root" / >&2
buildah "${tools[@]}" config --entrypoint '["/opt/foretouch/bin/foretouch"]' --cmd '["--help"]' --workingdir /data \
  --label org.opencontainers.image.version="$version" --label org.opencontainers.image.title=foretouch \
  --history-comment '' "$container"
rm -f "$output"
buildah "${tools[@]}" commit --quiet --disable-compression=false --timestamp "$SOURCE_DATE_EPOCH" "$container" "oci-archive:$output:foretouch:$version" >&2
# buildah dates the files of the image, but those of its archive are as old as the archive.
mkdir "$scratch/image"
tar -xf "$output" -C "$scratch/image"
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$SOURCE_DATE_EPOCH" -cf "$output" -C "$scratch/image" \
  blobs index.json oci-layout
echo "$output"
