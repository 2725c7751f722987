#include "grids/bag_metadata.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "tables/digest.h"

namespace albtpu {
namespace {

constexpr char kIsoLists[] = "http://www.isotc211.org/2005/resources/Codelist/gmxCodelists.xml#";
constexpr char kBagLists[] = "http://www.opennavsurf.org/schema/bag/bagCodelists.xml#";
// Elevations upwards in metres, of a datum that is not stated.
constexpr char kUnknownVertical[] =
    "VERT_CS[\"unknown\",VERT_DATUM[\"unknown\",2000],UNIT[\"metre\",1],AXIS[\"Up\",UP]]";

std::string Escaped(absl::string_view text) {
  return absl::StrReplaceAll(text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}});
}

// <name>children</name>
template <typename... Children>
std::string Element(absl::string_view name, const Children&... children) {
  return absl::StrCat("<", name, ">", children..., "</", name, ">\n");
}

std::string Text(absl::string_view text) {
  return absl::StrCat("<gco:CharacterString>", text, "</gco:CharacterString>");
}

// A word of a list, as ISO 19139 has it: within a property.
std::string Code(absl::string_view property, absl::string_view list, absl::string_view word) {
  const absl::string_view where = absl::StartsWith(list, "bag:") ? kBagLists : kIsoLists;
  return Element(property, "<", list, " codeList=\"", where, list.substr(4), "\" codeListValue=\"", word, "\">", word,
                 "</", list, ">");
}

std::string Language() {
  return Element("gmd:language",
                 "<gmd:LanguageCode codeList=\"http://www.loc.gov/standards/iso639-2/\" codeListValue=\"eng\">eng"
                 "</gmd:LanguageCode>");
}

std::string Utf8() { return Code("gmd:characterSet", "gmd:MD_CharacterSetCode", "utf8"); }
std::string Dataset(absl::string_view property) { return Code(property, "gmd:MD_ScopeCode", "dataset"); }

// An organisation in a role. ISO needs a name of a person, an organisation or a position.
std::string Party(absl::string_view property, const std::string& organisation, absl::string_view role) {
  return Element(
      property, Element("gmd:CI_ResponsibleParty",
                        Element("gmd:organisationName", Text(organisation.empty() ? "unknown" : Escaped(organisation))),
                        Code("gmd:role", "gmd:CI_RoleCode", role)));
}

std::string Citation(absl::string_view property, const std::string& title, absl::string_view date) {
  return Element(
      property,
      Element("gmd:CI_Citation", Element("gmd:title", Text(title)),
              Element("gmd:date", Element("gmd:CI_Date", Element("gmd:date", Element("gco:Date", date.substr(0, 10))),
                                          Code("gmd:dateType", "gmd:CI_DateTypeCode", "creation")))));
}

std::string Axis(absl::string_view name, absl::string_view size, absl::string_view step) {
  return Element("gmd:axisDimensionProperties",
                 Element("gmd:MD_Dimension", Code("gmd:dimensionName", "gmd:MD_DimensionNameTypeCode", name),
                         Element("gmd:dimensionSize", Element("gco:Integer", size)),
                         Element("gmd:resolution", "<gco:Measure uom=\"metre\">", step, "</gco:Measure>")));
}

std::string CornerPlace() {
  return Element(
      "gmd:spatialRepresentationInfo",
      Element("gmd:MD_Georectified", Element("gmd:numberOfDimensions", Element("gco:Integer", "2")),
              Axis("row", "${HEIGHT}", "${RESY}"), Axis("column", "${WIDTH}", "${RESX}"),
              Code("gmd:cellGeometry", "gmd:MD_CellGeometryCode", "point"),
              Element("gmd:transformationParameterAvailability", Element("gco:Boolean", "1")),
              Element("gmd:checkPointAvailability", Element("gco:Boolean", "0")),
              Element("gmd:cornerPoints", "<gml:Point gml:id=\"id1\"><gml:coordinates decimal=\".\" cs=\",\" ts=\" \">",
                      "${CORNER_POINTS}</gml:coordinates></gml:Point>"),
              Element("gmd:pointInPixel", Element("gmd:MD_PixelOrientationCode", "center"))));
}

std::string System(absl::string_view wkt) {
  return Element("gmd:referenceSystemInfo",
                 Element("gmd:MD_ReferenceSystem", Element("gmd:referenceSystemIdentifier",
                                                           Element("gmd:RS_Identifier", Element("gmd:code", Text(wkt)),
                                                                   Element("gmd:codeSpace", Text("WKT"))))));
}

std::string Extent(const BagFacts& facts) {
  const auto bound = [](const char* property, const char* name) {
    return Element(property, Element("gco:Decimal", name));
  };
  std::string extent = Element("gmd:geographicElement", Element("gmd:EX_GeographicBoundingBox",
                                                                bound("gmd:westBoundLongitude", "${WEST_LONGITUDE}"),
                                                                bound("gmd:eastBoundLongitude", "${EAST_LONGITUDE}"),
                                                                bound("gmd:southBoundLatitude", "${SOUTH_LATITUDE}"),
                                                                bound("gmd:northBoundLatitude", "${NORTH_LATITUDE}")));
  if (facts.first_survey.has_value() && facts.last_survey.has_value())
    absl::StrAppend(&extent,
                    Element("gmd:temporalElement",
                            Element("gmd:EX_TemporalExtent",
                                    Element("gmd:extent", "<gml:TimePeriod gml:id=\"survey\">",
                                            Element("gml:beginPosition", *facts.first_survey),
                                            Element("gml:endPosition", *facts.last_survey), "</gml:TimePeriod>"))));
  absl::StrAppend(
      &extent, Element("gmd:verticalElement",
                       Element("gmd:EX_VerticalExtent",
                               Element("gmd:minimumValue", Element("gco:Real", absl::StrFormat("%.3f", facts.lowest))),
                               Element("gmd:maximumValue", Element("gco:Real", absl::StrFormat("%.3f", facts.highest))),
                               "<gmd:verticalCRS gco:nilReason=\"inapplicable\"/>")));
  return Element("gmd:extent", Element("gmd:EX_Extent", extent));
}

std::string Identification(const BagFacts& facts) {
  return Element(
      "gmd:identificationInfo",
      Element("bag:BAG_DataIdentification", Citation("gmd:citation", Escaped(facts.title), facts.made),
              Element("gmd:abstract", Text(Escaped(facts.abstract))),
              Code("gmd:status", "gmd:MD_ProgressCode", "completed"),
              Code("gmd:spatialRepresentationType", "gmd:MD_SpatialRepresentationTypeCode", "grid"),
              Element("gmd:spatialResolution",
                      Element("gmd:MD_Resolution",
                              Element("gmd:distance", "<gco:Distance uom=\"metre\">${RES}</gco:Distance>"))),
              Language(), Utf8(), Element("gmd:topicCategory", Element("gmd:MD_TopicCategoryCode", "elevation")),
              Extent(facts), Code("bag:verticalUncertaintyType", "bag:BAG_VertUncertCode", "productUncert"),
              Code("bag:depthCorrectionType", "bag:BAG_DepthCorrectCode", "trueDepth")));
}

std::string Lineage(const BagFacts& facts) {
  return Element(
      "gmd:dataQualityInfo",
      Element("gmd:DQ_DataQuality", Element("gmd:scope", Element("gmd:DQ_Scope", Dataset("gmd:level"))),
              Element("gmd:lineage",
                      Element("gmd:LI_Lineage",
                              Element("gmd:processStep",
                                      Element("bag:BAG_ProcessStep",
                                              Element("gmd:description",
                                                      Text(Escaped(absl::StrCat(facts.software, ": ", facts.process)))),
                                              Element("gmd:dateTime", Element("gco:DateTime", facts.made)),
                                              Party("gmd:processor", facts.organisation, "processor"),
                                              Element("gmd:source",
                                                      Element("gmd:LI_Source",
                                                              Element("gmd:description", Text(Escaped(facts.source))))),
                                              Element("bag:trackingId", Text("1"))))))));
}

std::string Constraints() {
  return absl::StrCat(Element("gmd:metadataConstraints",
                              Element("gmd:MD_LegalConstraints",
                                      Code("gmd:useConstraints", "gmd:MD_RestrictionCode", "otherRestrictions"),
                                      Element("gmd:otherConstraints", Text("unknown")))),
                      Element("gmd:metadataConstraints",
                              Element("gmd:MD_SecurityConstraints",
                                      Code("gmd:classification", "gmd:MD_ClassificationCode", "unclassified"),
                                      Element("gmd:userNote", Text("none")))));
}

}  // namespace

std::string BagMetadata(const BagFacts& facts) {
  Sha256 identifier;
  for (const std::string& part : {facts.title, facts.abstract, facts.source, facts.made}) identifier.Update(part);
  return absl::StrCat(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gmi:MI_Metadata xmlns:gmi=\"http://www.isotc211.org/2005/gmi\" "
      "xmlns:gmd=\"http://www.isotc211.org/2005/gmd\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xmlns:gml=\"http://www.opengis.net/gml/3.2\" xmlns:gco=\"http://www.isotc211.org/2005/gco\" "
      "xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:bag=\"http://www.opennavsurf.org/schema/bag\">\n",
      Element("gmd:fileIdentifier", Text(Hex(identifier.Finish()))), Language(), Utf8(), Dataset("gmd:hierarchyLevel"),
      Party("gmd:contact", facts.organisation, "pointOfContact"),
      Element("gmd:dateStamp", Element("gco:Date", facts.made.substr(0, 10))),
      Element("gmd:metadataStandardName", Text("ISO 19115")),
      Element("gmd:metadataStandardVersion", Text("2003/Cor.1:2006")), CornerPlace(), System("${HORIZ_WKT}"),
      System(Escaped(facts.vertical_wkt.empty() ? kUnknownVertical : facts.vertical_wkt)), Identification(facts),
      Lineage(facts), Constraints(), "</gmi:MI_Metadata>\n");
}

}  // namespace albtpu
