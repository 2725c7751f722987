# Sourced by quickstart.sh and test.sh: the Debian packages of packages.txt.

# Prints the names in packages.txt: those that building takes, and with a word such as `tests` those of the section
# below its line "# tests only".
package_names() {
  {
    sed '/ only$/,$d' packages.txt
    [[ $# == 0 ]] || sed -n "/^# $1 only\$/,/ only\$/p" packages.txt
  } | sed '/^#/d; /^$/d'
}

# Installs those that are missing, as root or through sudo; nothing is touched when none is.
install_packages() {
  if ! command -v apt-get dpkg-query >/dev/null; then
    echo "$0: no apt-get: Debian 12 is right, or a machine that has what packages.txt lists" >&2
    return 1
  fi
  local installed missing
  installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p')
  ! command -v kubectl >/dev/null || installed+=$'\nkubernetes-client'  # Another than Debian's does as well.
  missing=$(comm -13 <(sort -u <<<"$installed") <(package_names "$@" | sort -u))
  [[ -n $missing ]] || return 0
  local names as_root=()
  mapfile -t names <<<"$missing"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "$0: packages are missing and there is no sudo: as root, apt-get install ${names[*]}" >&2
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
