#!/usr/bin/env bash
# Unpacks Debian packages of another architecture, with all that they depend on, into a folder that
# a cross compiler takes for the root of the file system:
#   make-sysroot.sh FOLDER ARCHITECTURE MULTIARCH PACKAGE...
# apt works in the folder with a state of its own. So nothing is installed, and it needs no root.
set -euo pipefail
folder=$1 architecture=$2 multiarch=$3
shift 3
[[ ! -e $folder/complete ]] || exit 0

rm -rf "$folder"
mkdir -p "$folder"/usr/{bin,sbin,lib} "$folder"/apt/{state/lists,cache/archives}/partial
folder=$(realpath "$folder")
: >"$folder/apt/status"
cat >"$folder/apt/apt.conf" <<END
APT::Architecture "$architecture";
APT::Architectures { "$architecture"; };
Dir::State "$folder/apt/state";
Dir::State::status "$folder/apt/status";
Dir::Cache "$folder/apt/cache";
END
export APT_CONFIG=$folder/apt/apt.conf
apt-get -qq update
apt-get -qq install -y --no-install-recommends --download-only "$@"

# As on any Debian of today, /lib is /usr/lib.
for name in bin sbin lib; do ln -s "usr/$name" "$folder/$name"; done
for package in "$folder"/apt/cache/archives/*.deb; do
  dpkg-deb --fsys-tarfile "$package" |
    tar -x --keep-directory-symlink --exclude=./usr/share/{doc,locale,man} -C "$folder"
done
# Absolute links must stay within the folder.
find "$folder" -type l -lname '/*' -printf '%p\t%l\n' |
  while IFS=$'\t' read -r link target; do ln -sfn "$folder$target" "$link"; done
# Installing these two would make links to them.
for name in blas lapack; do
  library=$folder/usr/lib/$multiarch/$name/lib$name.so.3
  [[ ! -e $library ]] || ln -sf "$name/lib$name.so.3" "$folder/usr/lib/$multiarch"
done
rm -rf "$folder/apt"
touch "$folder/complete"
