#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "idl/topics.hpp"

namespace slod::wire {
namespace {

std::string idl_text()
{
    std::ifstream file(SLOD_IDL_FILE);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// What the first group of `pattern` matches in the IDL, wherever it does.
std::multiset<std::string> matches_in_idl(const std::string& pattern)
{
    const std::string text = idl_text();
    const std::regex expression(pattern);
    std::multiset<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), expression); match != std::sregex_iterator();
         ++match)
        found.insert((*match)[1]);
    return found;
}

std::vector<TopicInfo> table()
{
    std::vector<TopicInfo> rows;
    for_each_topic([&](const TopicInfo& row) { rows.push_back(row); });
    return rows;
}

TEST(WireTopics, TheTableHasEveryTopicTypeOfTheIdlOnce)
{
    std::multiset<std::string> in_idl;
    for (const std::string& name : matches_in_idl("@topic @final struct (\\w+)"))
        in_idl.insert("slod::v1::" + name);
    std::multiset<std::string> in_table;
    for (const TopicInfo& row : table())
        in_table.insert(row.descriptor->m_typename);
    EXPECT_FALSE(in_idl.empty());
    EXPECT_EQ(in_table, in_idl);
}

// Only final types have the plain encoding that every vendor reads.
TEST(WireTopics, EveryStructIsFinalAndEitherATopicOrNested)
{
    EXPECT_EQ(matches_in_idl("\\bstruct (\\w+)"),
              matches_in_idl("@(?:topic @final|final @nested) struct (\\w+)"));
}

TEST(WireTopics, NamesAreUnique)
{
    std::set<std::string_view> names;
    for (const TopicInfo& row : table())
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

// A second server, or a second client, must not overwrite the first one's samples.
TEST(WireTopics, EveryInstanceBelongsToItsSender)
{
    for (const TopicInfo& row : table()) {
        ASSERT_GT(row.descriptor->m_nkeys, 0U) << row.name;
        const bool by_client = row.sender == Sender::Client || row.name == "command_reply";
        EXPECT_STREQ(row.descriptor->m_keys[0].m_name, by_client ? "client" : "session") << row.name;
    }
}

// A sample written to a region's partition must say which region, or readers of all could not tell.
TEST(WireTopics, TopicsByRegionAreKeyedByRegion)
{
    for (const TopicInfo& row : table()) {
        const std::span keys(row.descriptor->m_keys, row.descriptor->m_nkeys);
        const bool keyed = std::any_of(keys.begin(), keys.end(), [](const auto& key) {
            return std::string_view(key.m_name) == "region";
        });
        EXPECT_TRUE(keyed || !row.by_region) << row.name;
    }
}

} // namespace
} // namespace slod::wire
