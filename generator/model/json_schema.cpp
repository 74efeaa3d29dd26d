// SPDX-License-Identifier: GPL-2.0-or-later
/// The table of the format as JSON Schema 2020-12. It knows no names of a model, and no sizes.
#include "model/schema.hpp"

#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

Record reference(const char* name)
{
    return {{"$ref", fmt::format("#/$defs/{}", name)}};
}

Record typed(const char* type)
{
    return {{"type", type}};
}

Record any_of(std::initializer_list<Record> schemas)
{
    Record list = Record::array();
    for (const Record& each : schemas) list.push_back(each);
    return {{"anyOf", list}};
}

Record list_with(const Record& items)
{
    return {{"type", "array"}, {"items", items}};
}

Record requires_all(const std::vector<std::string>& keys)
{
    return {{"required", keys}};
}

/// The conditions that `needs` of a table says.
void append_needs(Record& conditions, const char* needs)
{
    for (const auto& [keys, optional, inclusive] : needs_of(needs)) {
        if (keys.size() == 1)
            conditions.push_back(requires_all(keys));
        else if (!optional)
            conditions.push_back({{inclusive ? "anyOf" : "oneOf",
                                   list_of(keys, [](const std::string& key) { return requires_all({key}); })}});
        for (std::size_t a = 0; optional && a < keys.size(); ++a)
            for (std::size_t b = a + 1; b < keys.size(); ++b)
                conditions.push_back({{"not", requires_all({keys[a], keys[b]})}});
    }
}

/// The conditions of each word of `kind`; the first word stands where there is none in [algebroid].
void append_kinds(Record& conditions, std::string_view block)
{
    bool first = block == "algebroid";
    for (const KindRow& row : kind_rows()) {
        if (row.block != block) continue;
        Record condition{{"properties", {{"kind", {{"const", row.kind}}}}}};
        if (!first) condition["required"] = {"kind"};
        first = false;
        std::vector<std::string> keys = words_of(row.keys);
        for (const char* each : {"kind", "fibre", "momenta"}) keys.emplace_back(each);
        Record needs = Record::array();
        append_needs(needs, row.needs);
        Record then{{"propertyNames", {{"enum", keys}}}};
        add_unless_empty(then, "allOf", needs);
        conditions.push_back({{"if", condition}, {"then", then}});
    }
}

Record schema_of(const SchemaRow& row);

Record table_of(const SchemaRow& row)
{
    Record properties = Record::object();
    for (const std::string& key : keys_below(row)) properties[key] = schema_of(*row_below(row, key));
    Record schema{{"type", "object"}};
    add_unless_empty(schema, "properties", properties);
    const SchemaRow* any = row_below(row, "*");
    schema["additionalProperties"] = any == nullptr ? Record(false) : schema_of(*any);
    Record conditions = Record::array();
    append_needs(conditions, row.needs);
    append_kinds(conditions, row.path == "algebroid.of" ? "algebroid" : row.path);
    add_unless_empty(schema, "allOf", conditions);
    return schema;
}

Record shape_of(const SchemaRow& row)
{
    switch (row.kind) {
    case ValueKind::text: return typed("string");
    case ValueKind::word: return {{"enum", words_for(row).words}};
    case ValueKind::strings: return reference("strings");
    case ValueKind::flag: return typed("boolean");
    case ValueKind::count: return {{"type", "integer"}, {"minimum", row.least}, {"maximum", row.most}};
    case ValueKind::expression: return reference("expression");
    case ValueKind::array: return reference("array");
    case ValueKind::matrices: {
        Record list = list_with(reference("array"));
        list["minItems"] = 1;
        return list;
    }
    case ValueKind::times: return list_with(reference("expression"));
    case ValueKind::interval: {
        Record list = list_with(reference("array"));
        list["minItems"] = list["maxItems"] = 2;
        return list;
    }
    case ValueKind::panels: return list_with(any_of({typed("string"), reference("strings")}));
    case ValueKind::table: return table_of(row);
    case ValueKind::line: return any_of({table_of(row), reference("array")});
    case ValueKind::file: return any_of({table_of(row), typed("string")});
    case ValueKind::algebroid: return any_of({reference("algebroid"), typed("string"), reference("strings")});
    case ValueKind::later: return Record::object();
    }
    return Record::object();
}

/// With its documentation, and the names that an expression may use.
Record schema_of(const SchemaRow& row)
{
    std::string text = row.text;
    if (row.roles == any_role) {
        text += "; may use every name of the model";
    } else if (row.roles != Roles()) {
        std::vector<std::string> names;
        for (Role role = Role::time; role < Role::built_in; role = static_cast<Role>(static_cast<int>(role) + 1))
            if (row.roles.has(role)) names.push_back(role_plural(role));
        text += "; may use " + comma_list(names);
    }
    Record schema{{"description", text}};
    schema.update(shape_of(row));
    return schema;
}

} // namespace

Record json_schema()
{
    const SchemaRow& root = schema_rows().front();
    const Record number_or_text{{"type", {"number", "string"}}};
    Record schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                  {"title", "lagen model"},
                  {"description", root.text}};
    schema.update(table_of(root));
    Record& definitions = schema["$defs"];
    definitions["expression"] = number_or_text;
    definitions["array"] = any_of({number_or_text, list_with(any_of({number_or_text, list_with(number_or_text)}))});
    definitions["strings"] = list_with(typed("string"));
    for (const SchemaRow& row : schema_rows())
        if (row.kind == ValueKind::algebroid) definitions["algebroid"] = table_of(row);
    return schema;
}

std::string json_schema_text()
{
    return json_schema().dump(2) + "\n";
}

} // namespace lagen
