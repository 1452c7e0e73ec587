#pragma once

#include "protocol/fields/fields.h"
#include "protocol/report/node_list.h"

/// The rows of a scene's nodes; see field_rows.h.
namespace gnomon {

template <>
inline constexpr auto kRows<NodeSummary> = replyRows(
    "NodeSummary", "A node of the file.", field("node", &NodeSummary::node, {.says = "Its index, for `nodes[].node`."}),
    field("name", &NodeSummary::name, {.says = "Its name; may be empty, and others may have the same."}),
    field("parent", &NodeSummary::parent, {.says = "Index of the node above it; absent = a root."}),
    field("triangles", &NodeSummary::triangles, {.says = "Triangles that it places itself, without those below it."}));
static_assert(kRowsAreComplete<NodeSummary>);

template <>
inline constexpr auto kRows<NodePage> = rows("NodePage", "Which part of a scene's nodes is asked for.",
                                             field("after", &NodePage::after,
                                                   {.says = "Index of the last node that is known."}),
                                             field("limit", &NodePage::limit, {.says = "The most nodes on the page."}));
static_assert(kRowsAreComplete<NodePage>);

template <>
inline constexpr auto kRows<NodeList> = replyRows(
    "NodeList", "A page of a scene's nodes, by index.", field("nodes", &NodeList::nodes, {.says = "The nodes."}),
    field("next", &NodeList::next, {.says = "Where there are more: what `after` asks for the next page with."}));
static_assert(kRowsAreComplete<NodeList>);

} // namespace gnomon
