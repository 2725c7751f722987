#!/usr/bin/env bash
# From a bare Debian 12 or 13 to a survey file with THU and TVU at every bathymetric point, without user input: builds
# the programs, makes a small table by Monte Carlo, serves it and annotates a flight line through the service.
# Everything that it writes is in build/ and out/ beside this file.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source ./packages.sh

campaign=generator/campaigns/quick.toml
table=out/tables/quick.h5
sample=../shared/data/florida_topobathy_snippet.las  # From a real survey; optional, not part of this repository.
simulated=out/simulated
annotated=out/annotated.las

install_packages

echo "== Building"
cmake --preset release >/dev/null
targets=(albtpu-generate albtpu-serve albtpu-query albtpu_manual)
[[ -r $sample ]] || targets+=(albtpu_simulated_survey)
cmake --build --preset release -j "$(nproc)" --target "${targets[@]}"
cmake --install build/release --prefix out >/dev/null

echo "== Making $table by Monte Carlo from $campaign"
mkdir -p out/tables
if [[ $table -nt $campaign && $table -nt out/bin/albtpu-generate ]]; then
  echo "$table exists and is newer than the campaign and the program."
else
  out/bin/albtpu-generate table --campaign "$campaign" --output "$table" --overwrite
fi

echo "== Starting the service"
exec {service_log}< <(exec out/bin/albtpu-serve --tables out/tables --listen 127.0.0.1:0 2>&1)
service=$!
trap 'kill "$service" 2>/dev/null && wait "$service" 2>/dev/null || true' EXIT
read -r ready <&"$service_log" || ready="albtpu-serve ended without output"
echo "$ready"
[[ $ready =~ 'ready on '([^,]+) ]] || exit 1
address=${BASH_REMATCH[1]}

echo "== Annotating a flight line through the service"
# Heights are above the ellipsoid, so that no vertical datum adds to the uncertainty.
# What is known of the water and of the receiver; a survey has its own numbers.
cat > out/survey.toml <<'END'
[water]
kd = 0.12                  # 1/m
kd_kind = "diffuse532"
detector = "peak"
field_of_view = 3          # m on the surface
pulse_length = 1.5         # ns
bias = "none"              # what scattering does to the bottom is in the points
END
conditions=(--survey out/survey.toml --sensor riegl-vq-880-g --datum-sigma 0 --wind-speed 5 --s44-order 1b
            --coverage p95 --details)
if [[ -r $sample ]]; then
  input=$sample
  conditions+=(--trajectory-from-returns --classes 26 --water-level -23.09)
else
  echo "$sample is missing; using a simulated flight line and its trajectory."
  input=$simulated/flight.las
  conditions+=(--trajectory $simulated/sbet.out --lever-arm 0.3,-0.2,0.5 --water-classes 41 --water-level -25
               --wind-from 250)
  mkdir -p "$simulated"
  build/release/tests/flights/albtpu_simulated_survey "$simulated"
fi
echo "albtpu-query las $input $annotated --server $address ${conditions[*]}"
out/bin/albtpu-query las "$input" "$annotated" --server "$address" "${conditions[@]}" --overwrite

echo "== Reporting whether the line passes"
out/bin/albtpu-query report "$annotated" --output out/report --overwrite

echo "== Done"
echo "$annotated has total_thu and total_tvu at each bathymetric point, at 95 %, in m: of sensor and trajectory, the"
echo "location of the surface, the sea surface, the water column and the datum; its contributions, biases and"
echo "covariance; and the geometry of its beam: incidence, beam_azimuth, footprint, water_depth and slant_range."
echo "out/report/report.html states whether THU and TVU are within the limits of an order, and where and why not."
echo "To query a single pulse:"
echo "out/bin/albtpu-query pulse --table $table --wind-speed 7 --incidence 12 --footprint 0.6 --depth 8"
