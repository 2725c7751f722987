#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "status/status_macros.h"
#include "tables/file/hdf5.h"
#include "tables/file/hdf5_numbers.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tables/format.h"

namespace albtpu {
namespace {

using hdf5::Handle;

absl::Status About(std::string_view kind, const std::string& name, std::string_view problem) {
  return absl::InvalidArgumentError(absl::StrFormat("%s '%s' %s", std::string(kind), name, std::string(problem)));
}

absl::StatusOr<std::string> ReadText(hid_t object, std::string_view name) {
  const absl::StatusOr<AttributeValue> value = hdf5::ReadAttribute(object, std::string(name));
  if (!value.ok()) return absl::InvalidArgumentError(value.status().message());
  const std::string* text = std::get_if<std::string>(&*value);
  if (text == nullptr) return About("attribute", std::string(name), "is a number: it should be text");
  return *text;
}

// A dataset of float32. Its shape is checked before memory of the size that it claims is allocated.
struct FloatDataset {
  std::string name;
  Handle dataset;
  std::vector<hsize_t> shape;
};

// HDF5 would follow other links out of the file.
bool IsOfThisFile(hid_t file, const std::string& name) {
  H5L_info_t link;
  return H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
}

absl::StatusOr<FloatDataset> OpenDataset(hid_t file, std::string_view kind, std::string_view name_view) {
  const std::string name(name_view);
  if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0) return About(kind, name, "is missing");
  if (!IsOfThisFile(file, name)) return About(kind, name, "is a link: it should be a dataset of this file");
  Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset) return About(kind, name, "is not a dataset");
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (H5Tget_class(type) != H5T_FLOAT || H5Tget_size(type) != sizeof(float))
    return About(kind, name, "is of another type: it should be float32");
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0) return About(kind, name, "has no shape");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return FloatDataset{name, std::move(dataset), std::move(shape)};
}

// Requires that the shape has been checked.
absl::StatusOr<std::vector<float>> ReadFloats(const FloatDataset& from, std::string_view kind) {
  absl::StatusOr<std::vector<float>> values = hdf5::ReadFloats(from.dataset, from.shape);
  if (!values.ok()) return About(kind, from.name, std::string(values.status().message()));
  return values;
}

absl::Status CheckUnits(const FloatDataset& dataset, std::string_view kind, std::string_view expected) {
  const absl::StatusOr<std::string> units = ReadText(dataset.dataset, format::kUnits);
  if (!units.ok()) return About(kind, dataset.name, absl::StrCat("has no units: ", units.status().message()));
  if (*units == expected) return absl::OkStatus();
  return About(kind, dataset.name, absl::StrFormat("is in '%s': it should be in '%s'", *units, std::string(expected)));
}

absl::StatusOr<Scale> ReadScale(const FloatDataset& dataset, std::string_view kind) {
  const absl::StatusOr<std::string> name = ReadText(dataset.dataset, format::kInterpolation);
  if (!name.ok()) return About(kind, dataset.name, std::string(name.status().message()));
  for (Scale scale : {Scale::kLinear, Scale::kLog})
    if (*name == Name(scale)) return scale;
  return About(kind, dataset.name, absl::StrFormat("has interpolation '%s': it should be 'linear' or 'log'", *name));
}

absl::StatusOr<Axis> ReadAxis(hid_t file, const AxisSchema& schema) {
  ASSIGN_OR_RETURN(const FloatDataset dataset, OpenDataset(file, "axis", schema.name));
  if (dataset.shape.size() != 1)
    return About("axis", dataset.name, absl::StrFormat("has %d dimensions: it should have 1", dataset.shape.size()));
  if (dataset.shape[0] > format::kMaxNodeCount) {
    return About("axis", dataset.name,
                 absl::StrFormat("has %d nodes: it may have %d at most", dataset.shape[0], format::kMaxNodeCount));
  }
  RETURN_IF_ERROR(CheckUnits(dataset, "axis", schema.units));
  ASSIGN_OR_RETURN(const Scale scale, ReadScale(dataset, "axis"));
  ASSIGN_OR_RETURN(const std::vector<float> nodes, ReadFloats(dataset, "axis"));
  return Axis::Create(schema, {nodes.begin(), nodes.end()}, scale);
}

absl::StatusOr<Table::Axes> ReadAxes(hid_t file, const TableSchema& schema) {
  Table::Axes axes;
  std::size_t count = 1;
  for (const AxisSchema& axis_schema : schema.axes) {
    ASSIGN_OR_RETURN(Axis axis, ReadAxis(file, axis_schema));
    if (axis.size() > format::kMaxValueCount / count) {
      return absl::InvalidArgumentError(
          absl::StrFormat("the axes span more than %d nodes, the most that a table may have", format::kMaxValueCount));
    }
    count *= axis.size();
    axes.push_back(std::move(axis));
  }
  return axes;
}

// The values of a dataset that must span the axes of a quantity.
absl::StatusOr<std::vector<float>> ReadValues(const FloatDataset& dataset, const Table::Axes& axes,
                                              const QuantitySchema& quantity) {
  std::vector<hsize_t> expected;
  for (const Axis& axis : axes) expected.push_back(axis.size());
  if (!quantity.over_last_axis) expected.pop_back();
  if (dataset.shape != expected) {
    return About("variable", dataset.name,
                 absl::StrFormat("has the shape (%s): its axes have (%s)", absl::StrJoin(dataset.shape, ", "),
                                 absl::StrJoin(expected, ", ")));
  }
  RETURN_IF_ERROR(CheckUnits(dataset, "variable", quantity.units));
  return ReadFloats(dataset, "variable");
}

// nullopt if the file does not have the quantity; Table::Create decides whether it is required.
absl::StatusOr<std::optional<Variable>> ReadVariable(hid_t file, const Table::Axes& axes,
                                                     const QuantitySchema& quantity) {
  const std::string name(quantity.name);
  if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0) return std::nullopt;
  ASSIGN_OR_RETURN(const FloatDataset dataset, OpenDataset(file, "variable", name));
  ASSIGN_OR_RETURN(std::vector<float> values, ReadValues(dataset, axes, quantity));
  ASSIGN_OR_RETURN(const Scale scale, ReadScale(dataset, "variable"));
  Variable variable{std::move(values), {}, scale};

  const std::string error_name = name + std::string(kStandardErrorSuffix);
  if (H5Lexists(file, error_name.c_str(), H5P_DEFAULT) <= 0) return variable;
  ASSIGN_OR_RETURN(const FloatDataset errors, OpenDataset(file, "variable", error_name));
  ASSIGN_OR_RETURN(std::vector<float> standard_errors, ReadValues(errors, axes, quantity));
  ASSIGN_OR_RETURN(const Scale error_scale, ReadScale(errors, "variable"));
  if (error_scale != Scale::kLinear) return About("variable", error_name, "should have interpolation 'linear'");
  variable.standard_errors = std::move(standard_errors);
  return variable;
}

absl::StatusOr<Provenance> ReadProvenance(hid_t file) {
  Provenance provenance;
  for (const auto& [name, member] :
       {std::pair(format::kId, &Provenance::id), std::pair(format::kVersion, &Provenance::version),
        std::pair(format::kTitle, &Provenance::title), std::pair(format::kCampaign, &Provenance::campaign)}) {
    ASSIGN_OR_RETURN(std::string text, ReadText(file, name));
    provenance.*member = std::move(text);
  }
  ASSIGN_OR_RETURN(const std::vector<std::string> names, hdf5::AttributeNames(file));
  const auto& reserved = format::kReservedAttributes;
  for (const std::string& name : names) {
    if (std::find(reserved.begin(), reserved.end(), name) != reserved.end()) continue;
    ASSIGN_OR_RETURN(AttributeValue value, hdf5::ReadAttribute(file, name));
    const auto* const list = std::get_if<std::vector<double>>(&value);
    if (name == format::kRefractiveIndex && list != nullptr && list->size() == 1) value = double{list->front()};
    provenance.attributes[name] = std::move(value);
  }
  return provenance;
}

absl::Status CheckCoverage(hid_t file) {
  ASSIGN_OR_RETURN(const std::string coverage, ReadText(file, format::kCoverage));
  if (coverage == format::kCoverageValue) return absl::OkStatus();
  return About("attribute", std::string(format::kCoverage),
               absl::StrFormat("is '%s': it should be '%s'", coverage, std::string(format::kCoverageValue)));
}

using Kinds = std::span<const TableSchema* const>;

// The one of `kinds` that the file is of. A file without the attribute is of the default kind. One that names the
// default kind is refused, so that a table has one written form.
absl::StatusOr<const TableSchema*> KindOf(hid_t file, Kinds kinds) {
  std::string kind(format::kDefaultTableKind);
  if (H5Aexists(file, std::string(format::kTableKind).c_str()) > 0) {
    ASSIGN_OR_RETURN(const std::string named, ReadText(file, format::kTableKind));
    if (named == format::kDefaultTableKind) {
      return About("attribute", std::string(format::kTableKind),
                   absl::StrFormat("is '%s': files of that kind do not have it", named));
    }
    kind = named;
  }
  std::vector<std::string> names;
  for (const TableSchema* schema : kinds) {
    if (kind == schema->name) return schema;
    names.push_back(absl::StrCat("'", std::string(schema->name), "'"));
  }
  return absl::InvalidArgumentError(
      absl::StrFormat("is a table of kind '%s': expected kind %s", kind, absl::StrJoin(names, " or ")));
}

// Guards against a small file that fills the memory because one dataset has several names, or because several chunks
// lie in the same bytes.
absl::Status CheckStoredOnce(hid_t file, const TableSchema& schema, std::size_t length) {
  std::vector<std::string> names;
  for (const AxisSchema& axis : schema.axes) names.emplace_back(axis.name);
  for (const QuantitySchema& quantity : schema.quantities) {
    const std::string name(quantity.name);
    names.insert(names.end(), {name, name + std::string(kStandardErrorSuffix)});
  }
  std::size_t room = length;
  for (const std::string& name : names) {
    if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0 || !IsOfThisFile(file, name)) continue;
    const Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    const std::size_t stored = dataset ? H5Dget_storage_size(dataset) : 0;
    if (stored > room) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "has datasets of more bytes than the %d of the file: each should have bytes of its own", length));
    }
    room -= stored;
  }
  return absl::OkStatus();
}

absl::StatusOr<Table> ReadContents(hid_t file, Kinds kinds, std::size_t length) {
  ASSIGN_OR_RETURN(const TableSchema* kind, KindOf(file, kinds));
  const TableSchema& schema = *kind;
  RETURN_IF_ERROR(CheckCoverage(file));
  RETURN_IF_ERROR(CheckStoredOnce(file, schema, length));
  ASSIGN_OR_RETURN(Table::Axes axes, ReadAxes(file, schema));
  Table::Variables variables;
  for (const QuantitySchema& quantity : schema.quantities) {
    ASSIGN_OR_RETURN(std::optional<Variable> variable, ReadVariable(file, axes, quantity));
    variables.push_back(std::move(variable));
  }
  ASSIGN_OR_RETURN(Provenance provenance, ReadProvenance(file));
  ASSIGN_OR_RETURN(const std::string digest, ReadText(file, format::kContentDigest));

  absl::StatusOr<Table> table = Table::Create(schema, std::move(axes), std::move(variables), std::move(provenance));
  if (table.ok() && table->digest() != digest) {
    return About("attribute", std::string(format::kContentDigest),
                 absl::StrFormat("is '%s': the content has '%s'", digest, table->digest()));
  }
  return table;
}

absl::StatusOr<Table> Decode(absl::string_view file, Kinds kinds) {
  RETURN_IF_ERROR(seal::Check(file));
  const hdf5::Session session;
  // HDF5 reads the very bytes that were checked, not the file again.
  const Handle image = hdf5::OpenImage(file);
  if (!image) return absl::InvalidArgumentError("is sealed, but its content is not HDF5");
  return ReadContents(image, kinds, file.size());
}

}  // namespace

absl::StatusOr<Table> DecodeTable(absl::string_view file, const TableSchema& schema) {
  const TableSchema* const kind = &schema;
  return Decode(file, {&kind, 1});
}

absl::StatusOr<UncertaintyTable> DecodeTable(absl::string_view file) {
  ASSIGN_OR_RETURN(Table table, Decode(file, UncertaintyTable::kKinds));
  return UncertaintyTable(std::move(table));
}

}  // namespace albtpu
