// SPDX-License-Identifier: GPL-2.0-or-later
/// An [algebroid] table before its base is known: kind, inner tables, included files. The stages of reading it stand
/// here in the order in which read_algebroid_kind calls them.
#pragma once

#include "model/model_reader.hpp"

namespace lagen {

/// One table like [algebroid], or a file that stands for one.
struct AlgebroidDraft {
    Item table;        ///< nothing where a file or the groupoid stands for it
    std::string title; ///< "[algebroid]", "[algebroid.of]", ..; the file's name
    SourceRange where;
    std::optional<AlgebroidKind> kind; ///< nothing where a file stands for it
    std::size_t included = 0;          ///< number in ModelReader::included, where a file stands for it
    bool outermost = false;            ///< its fibre is the model's, which is declared later
    std::vector<Symbol> fibre;         ///< empty where left out
    std::vector<Symbol> momenta;       ///< empty where left out
    bool dual = false;
    LevelSetFrame level_set; ///< where it is one
    std::vector<AlgebroidDraft> of;
};

/// The number of sections of its algebroid, over `n` base coordinates.
[[nodiscard]] std::size_t rank_of(const GroupoidBlock& block, std::size_t n);
/// "so(n)" and "R^n" with the sizes of the model put in.
[[nodiscard]] std::string with_sizes(const std::string& algebra, const std::vector<Size>& sizes);
/// Reads the model that `of` names. Throws ModelError: no such file, a cycle, too many files.
[[nodiscard]] std::size_t include_model(ModelReader& reader, const TomlValue& of);

/// Parameters, sizes, families, constraints, Casimirs and domains of the included models join the model.
void merge_included(ModelReader& reader);
/// The names of their fibre coordinates in this model; `hidden`: they have none there.
void note_fibre_names(ModelReader& reader, const AlgebroidDraft& draft, const AlgebroidBlock& block, bool hidden);
/// Their definitions; once the fibre names are noted.
void inherit_definitions(ModelReader& reader);
/// Their Lagrangians, forces and dissipation, where the model has no mechanics of its own; once the entries are read.
void inherit_mechanics(ModelReader& reader);

/// `drift` and `constraints` of a nonholonomic block; once its sections are read. Throws ModelError (a constraint that
/// is not affine, or has no Y, and others).
void read_distribution(const ModelReader& reader, AlgebroidBlock& block, const AlgebroidDraft& draft);

/// The matrices of a list, over parameters, of the shape `wanted`; where that is left open square, and of the size of
/// the first. `hint` ends the message where one is of another, `title` begins it.
[[nodiscard]] std::vector<ArrayValue> read_matrices(const ModelReader& reader, const Item& list,
                                                    std::optional<Shape> wanted, const char* hint,
                                                    const std::function<std::string(std::size_t)>& title);
/// The entries of a table, and of the tables inside it, closed; `block` is their record.
void read_entries(const ModelReader& reader, AlgebroidBlock& block, const AlgebroidDraft& draft);
/// The base coordinates of a block.
[[nodiscard]] std::vector<Symbol> coordinates_of(const Model& model, const AlgebroidBlock& block);
/// "v_x" for each coordinate.
[[nodiscard]] std::vector<Symbol> velocities_of(const std::vector<Symbol>& coordinates);
/// Defines the inner velocities of the model's algebroid, whose entries are read.
void define_inner_velocities(ModelReader& reader);
/// The names that define_inner_velocities gives: families by their names.
[[nodiscard]] std::vector<std::string> velocity_names(const Model& model);

/// value * y, written as a person would: y itself where value is 1, -y where it is -1.
[[nodiscard]] Tree product_of(const Tree& value, const Tree& y);

/// 0 where there are no terms.
[[nodiscard]] Tree sum_of(const std::vector<Tree>& terms);

/// [a, b, ..] or [[a, b], ..] of this shape; a scalar is its one entry.
[[nodiscard]] Tree array_tree(const Shape& shape, const std::vector<Tree>& entries);

} // namespace lagen
