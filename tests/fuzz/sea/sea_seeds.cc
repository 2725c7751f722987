#include "tests/fuzz/sea/sea_seeds.h"

namespace albtpu::fuzz {
namespace {

using Seeds = std::vector<std::string>;

const std::string kEnergy =
    "#YY  MM DD hh mm Sep_Freq  < spec_1 (freq_1) spec_2 (freq_2) ... >\n"
    "2020 06 08 03 50 0.225 0.218 (0.100) 0.641 (0.200) 0.000 (0.400)\n"
    "2020 06 08 02 50 9.999 0.100 (0.100) 999.00 (0.200) 0.300 (0.400)\n";
const std::string kSpread =
    "#YY  MM DD hh mm r2_1 (freq_1) r2_2 (freq_2) ... >\n"
    "2020 06 08 03 50 0.33 (0.100) 0.50 (0.200) 999.00 (0.400)\n";
const std::string kDirection =
    "#YY  MM DD hh mm alpha2_1 (freq_1) alpha2_2 (freq_2) ... >\n"
    "2020 06 08 03 50 30.0 (0.100) 999.0 (0.200) 120.0 (0.400)\n";
const std::string kHistory = "#YY  MM DD hh mm  .0500  .1000\n2019 02 06 00 40";

Seeds NdbcSpectra() {
  const std::string zero(1, '\0');
  return {kEnergy, kEnergy + zero + kSpread + zero + kDirection,
          kHistory + " 0.00 1.21\n" + zero + kHistory + " 94 999\n" + zero + kHistory + " 146 24\n",
          "YY MM DD hh .03 .04\n96 02 29 23 .00 .12\n"};
}

Seeds NdbcBulk() {
  return {
      "#YY  MM DD hh mm WVHT  SwH  SwP  WWH  WWP SwD WWD  STEEPNESS  APD MWD\n#yr  mo dy hr mn\n"
      "2020 06 08 03 40  1.1  1.0  5.6  0.5  3.6 SSW  SE STEEP  4.9 196\n"
      "2020 06 08 02 40  1.2   MM   MM  0.9  5.9  MM   S STEEP  4.8 175\n",
      "YYYY MM DD hh WD   WSPD GST  WVHT  DPD   APD  MWD  BAR\n2000 01 01 01 230 07.2 09.0 01.10 08.00 04.00 "
      "120 1020.1\n"};
}

Seeds Ww3Points() {
  return {
      "'WAVEWATCH III SPECTRA'      2     8     1 'x'\n 0.100E+00 0.200E+00\n"
      "  0.157E+01  0.785E+00  0.000E+00  0.550E+01  0.471E+01  0.393E+01  0.314E+01  0.236E+01\n"
      "20220912 060000\n'44097     '  40.98-171.12      46.6   1.45 225.6   0.18  94.1\n"
      "  0.1E+00  0.2E+00  0.0E+00  0.6E+00  0.0E+00  0.0E+00  0.0E+00  0.123-104\n"
      "  0.1E+00  0.2E+00  0.0E+00  0.6E+00  0.0E+00  0.0E+00  0.0E+00  0.1E-01\n"};
}

Seeds SwanSpectra() {
  const std::string grid =
      "AFREQ\n2\n0.1\n0.2\nNDIR\n8\n0\n45\n90\n135\n180\n225\n270\n315\nQUANT\n1\nVaDens\nm2/Hz/degr\n-99\n";
  const std::string spectrum = "FACTOR\n1E-4\n1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 8\n";
  return {
      "SWAN   1\n$ x\nTIME\n1\nLONLAT\n1\n1 2\n" + grid + "20161011.123000\n" + spectrum + "20161011.133000\nZERO\n",
      "SWAN 1\nLOCATIONS\n2\n1 2 'a'\n3 4\n" + grid + spectrum + "NODATA\n",
      "SWAN 1\nLOCATIONS\n1\n1 "
      "2\nRFREQ\n2\n0.1\n0.2\nCDIR\n8\n0\n45\n90\n135\n180\n225\n270\n315\nQUANT\n1\nEnDens\n"
      "J/m2/Hz/degr\n-99\n" +
          spectrum};
}

Seeds SeaCsv() {
  return {"# x\nf,E,r2,alpha2\n0.05,0.12,0.41,230\n0.06,0.31,,\n",
          "k,S,a2,b2,a4,b4\n0.1,1,0.5,0.1,0,0\n0.2,2,0,0,0,1\n",
          "time,f,E\n2020-06-08T03:50Z,0.1,1\n2020-06-08T03:50Z,0.2,2\n2020-06-08T03:51:07Z,0.1,1\n2020-06-"
          "08T03:51:07Z,0.2,2\n"};
}

// "hello" and nothing, compressed by gzip -n.
Seeds Gzip() {
  return {std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xcb\x48\xcd\xc9\xc9\x07\x00\x86\xa6\x10\x36\x05"
                      "\x00\x00\x00",
                      25),
          std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x03\x00\x00\x00\x00\x00\x00\x00\x00\x00", 20)};
}

Seeds SurveyDescription() {
  const std::string waves = "[[sea.waves]]\nhs = 0.42\ntp = 2.7\nwaves_from = 225\n";
  return {"[sea]\nwind_speed = 6.5\nwind_from = 225\nwater_depth = 12\ntail = \"relax\"\ntail_from = 0.95\n" + waves +
              "gamma = 3.3\nspreading = \"mitsuyasu\"\n" + waves + "spread = 18\n",
          "[sea]\nfile = \"41010.data_spec\"\ntime = \"2020-06-08T03:50Z\"\nplace = \"28.9,-78.5\"\n"
          "longest_gap = 6\nanemometer_height = 4\n",
          "sea = {wind_speed = 0, waves = [{hs = 1, tp = 9, waves_from = 0}]}\n",
          "[sea]\nwind_speed = \"6 m/s\"\n",
          "[sea]\ntime = 2020-06-08T03:50:00Z\n",
          "[sea.waves]\nhs = nan\n",
          "[see]\n",
          "[sensor]\nname = \"mine.toml\"\nlever_arm = [0.3, -0.2, 5]\n[trajectory]\nfiles = [\"sbet/\", \"b\"]\n"
          "errors = [\"smrmsg/\"]\ntime = \"gps\"\n[surface]\nclasses = [41, 9]\nlocated = \"local\"\n",
          "[trajectory]\nfrom_returns = true\n[surface]\nlocated = \"level\"\nlevel = -23.09\n[water]\nindex = "
          "1.34\n"
          "kd = 0.12\ntemperature = 24\nsalinity = 36\ncolumn = \"none\"\n[datum]\nsigma = 0.08\n"
          "geoid_separation = -25.1\n[output]\nclasses = [40]\ncoverage = \"p95\"\ns44_order = \"1b\"\n"
          "details = true\n",
          "[surface]\nlevel = \"level.csv\"\n[sigma]\nposition = [0.02, 0.02, 0.06]\nattitude = [0.005, 0, "
          "0.008]\n"
          "boresight = [0.001, 0.001, 0.004]\nlever_arm = 0.02\nscan = 0.02\ntime = 1e-5\nrange_offset = 0.01\n"
          "bottom_range = 0.025\nsurface_height = 0.05\nindex = 0.001\n"};
}

Seeds SensorFile() {
  const std::string end = "unit = \"degree\"\nsource = \"its data sheet\"\n";
  return {"title = \"Scanner\"\n[scan]\nvalue = 0.02\n" + end + "[attitude]\nvalue = [0.0025, 0.0025, 0.005]\n" + end +
              "[divergence]\nvalue = 1\nleast = 0.7\ngreatest = 2\nunit = \"mrad\"\nsource = \"b\"\n",
          "title = 'a'\nbottom_range = {value = 0.025, unit = 'm', source = 'b'}\n"
          "[position]\nvalue = [0, 1, 2]\nunit = 'm'\nsource = ' '\n",
          "title = 'a'\n[time]\nvalue = 1e-5\nunit = 's'\n"};
}

Seeds Specification() {
  const std::string head = "title = \"Harbour\"\nsource = \"order 12\"\n[[class]]\nname = \"berths\"\n";
  return {head +
              "coverage = \"p95\"\nhorizontal = {constant = 5, of_depth = 0.05, combined = \"sum\"}\n"
              "vertical = {constant = 0.25, of_depth = 0.0075, combined = \"rss\"}\n",
          head +
              "coverage = \"1sigma\"\nvertical = {constant = 0.1}\n[[class]]\nname = 'b'\n"
              "coverage = \"2sigma\"\n[class.horizontal]\nconstant = 1\n",
          head + "coverage = \"95\"\n"};
}

}  // namespace

std::map<std::string, Seeds> SeaSeeds() {
  std::map<std::string, Seeds> seeds = {{"ndbc_spectra", NdbcSpectra()}, {"ndbc_bulk", NdbcBulk()},
                                        {"ww3_points", Ww3Points()},     {"swan_spectra", SwanSpectra()},
                                        {"sea_csv", SeaCsv()},           {"sea_gzip", Gzip()}};
  Seeds texts;
  for (const auto& [target, inputs] : seeds)
    if (target != "sea_gzip") texts.insert(texts.end(), inputs.begin(), inputs.end());
  seeds["sea_text"] = std::move(texts);
  seeds["survey_description"] = SurveyDescription();
  seeds["sensor_file"] = SensorFile();
  seeds["specification"] = Specification();
  return seeds;
}

}  // namespace albtpu::fuzz
