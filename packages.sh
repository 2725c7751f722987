# Sourced by quickstart.sh and test.sh: installs the Debian packages that packages.txt lists.

# Prints the package names that the build needs; with an argument such as `tests`, also those of the section that begins
# with the line "# tests only".
package_names() {
  {
    sed '/ only$/,$d' packages.txt
    [[ $# == 0 ]] || sed -n "/^# $1 only\$/,/ only\$/p" packages.txt
  } | sed '/^#/d; /^$/d'
}

# Installs the missing ones, as root or through sudo. Does nothing if none is missing.
install_packages() {
  if ! command -v apt-get dpkg-query >/dev/null; then
    echo "$0: apt-get is missing (expected Debian 12 or 13); elsewhere, install the packages of packages.txt and" \
      "build with cmake --preset release" >&2
    return 1
  fi
  local installed missing
  installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p')
  ! command -v kubectl >/dev/null || installed+=$'\nkubernetes-client'  # Any kubectl will do, not only Debian's.
  missing=$(comm -13 <(sort -u <<<"$installed") <(package_names "$@" | sort -u))
  [[ -n $missing ]] || return 0
  local names as_root=()
  mapfile -t names <<<"$missing"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "$0: packages are missing, and so is sudo; as root, run apt-get install ${names[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  echo "== Installing ${#names[@]} Debian packages"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300
             -o Dpkg::Use-Pty=0 -o Acquire::Retries=3)
  "${apt[@]}" update
  "${apt[@]}" install --yes --no-install-recommends "${names[@]}" </dev/null >/dev/null
}
