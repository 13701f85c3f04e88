// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameter_reader.h"
#include "error_of.h"

#include <cmath>

#include <gmock/gmock.h>

namespace trk_bridge::ros1::parameter_reader_test {

using ::testing::ElementsAre;
using XmlRpc::XmlRpcValue;

std::string end_of(ParameterReader& reader) {
  return test::error_of<ParameterError>([&] { reader.finish(); });
}

tl::expected<std::size_t, std::string> parse_length(const std::string& text) {
  if (text.empty()) return tl::make_unexpected(std::string("must not be empty"));
  return text.size();
}

TEST(Ranges, DescribeWhatTheyAllow) {
  EXPECT_EQ((Range{0, 60, "seconds"}).text(), "0 to 60 seconds");
  EXPECT_EQ((Range{1, 100000}).text(), "1 to 100000");
  EXPECT_EQ(at_least(0).text(), "0 or more");
  EXPECT_EQ(at_least(0, "pixels").text(), "0 or more pixels");
  EXPECT_EQ(more_than(0, "mm").text(), "more than 0 mm");
  EXPECT_EQ(more_than(0.2, "metres", 1000).text(), "more than 0.2 and at most 1000 metres");
  EXPECT_EQ(Range{}.text(), "finite");
}

TEST(Ranges, IncludeTheirEndsAndNothingInfinite) {
  const Range range{0, 60, "seconds"};
  EXPECT_TRUE(range.contains(0) && range.contains(60));
  EXPECT_FALSE(range.contains(-1e-9) || range.contains(60.001));
  EXPECT_FALSE(more_than(0, "mm").contains(0));
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL}) EXPECT_FALSE(Range{}.contains(value)) << value;
}

TEST(ParameterReader, MissingAndFaultyValuesKeepTheirDefault) {
  XmlRpcValue tree;
  tree["number"] = "one";
  tree["integer"] = 11;
  tree["choice"] = "c";
  tree["parsed"] = "";
  tree["list"][0] = "abc";
  tree["list"][1] = "";
  ParameterReader reader(tree);
  double number = 1, other = 2;
  int integer = 3;
  char choice = 'a';
  std::size_t parsed = 5;
  std::vector<std::size_t> list{6};
  EXPECT_FALSE(reader.number("number", number));
  EXPECT_FALSE(reader.number("other", other));
  EXPECT_FALSE(reader.integer("integer", integer, {1, 10}));
  EXPECT_FALSE(reader.choice("choice", choice, {{"a", 'a'}, {"b", 'b'}}));
  EXPECT_FALSE(reader.parsed("parsed", parsed, parse_length));
  EXPECT_FALSE(reader.parsed_list("list", list, parse_length));
  EXPECT_EQ(number, 1);
  EXPECT_EQ(other, 2);
  EXPECT_EQ(integer, 3);
  EXPECT_EQ(choice, 'a');
  EXPECT_EQ(parsed, 5u);
  EXPECT_THAT(list, ElementsAre(6));
  EXPECT_TRUE(reader.are_valid({"other"}));
  for (const char* key : {"number", "integer", "choice", "parsed", "list"}) {
    EXPECT_FALSE(reader.are_valid({"other", key})) << key;
  }
  EXPECT_EQ(end_of(reader),
            "~number = 'one': must be a number\n"
            "~integer = 11: must be 1 to 10\n"
            "~choice = 'c': must be a or b\n"
            "~parsed = '': must not be empty\n"
            "~list = '': must not be empty");
}

TEST(ParameterReader, ValidTextsAreParsed) {
  XmlRpcValue tree;
  tree["number"] = 7;
  tree["flag"] = true;
  tree["choice"] = "b";
  tree["parsed"] = "abc";
  tree["list"] = "abcd";
  ParameterReader reader(tree);
  double number = 1;
  bool flag = false;
  char choice = 'a';
  std::size_t parsed = 5;
  std::vector<std::size_t> list;
  EXPECT_TRUE(reader.number("number", number));
  EXPECT_TRUE(reader.flag("flag", flag));
  EXPECT_TRUE(reader.choice("choice", choice, {{"a", 'a'}, {"b", 'b'}}));
  EXPECT_TRUE(reader.parsed("parsed", parsed, parse_length));
  EXPECT_TRUE(reader.parsed_list("list", list, parse_length));
  EXPECT_EQ(number, 7);
  EXPECT_TRUE(flag);
  EXPECT_EQ(choice, 'b');
  EXPECT_EQ(parsed, 3u);
  EXPECT_THAT(list, ElementsAre(4));
  EXPECT_EQ(end_of(reader), "no error");
}

TEST(ParameterReader, AFaultIsOneLineWhateverTextIsGiven) {
  XmlRpcValue tree;
  tree["length"] = std::string("two\nlines\tand \0 bells\a", 22);
  tree["unknown"] = 1;
  ParameterReader reader(tree);
  int length = 0;
  EXPECT_FALSE(reader.integer("length", length));
  EXPECT_EQ(end_of(reader),
            "~length = 'two\\nlines\\tand \\x00 bells\\x07': must be an integer\n"
            "~unknown = 1: unknown parameter, nearest is length; known are length");
}

TEST(ParameterReader, AMapInheritsValidityAndAddsItsFaults) {
  XmlRpcValue tree;
  tree["rate"] = "fast";
  tree["slow"]["rate"] = 1;
  tree["other"]["rat"] = 1;
  ParameterReader node(tree);
  double rate = 50;
  node.number("rate", rate);
  auto slow = node.map("slow"), other = node.map("other");
  ASSERT_TRUE(slow && other);
  slow->inherit(node);
  other->inherit(node);
  EXPECT_TRUE(slow->number("rate", rate));
  EXPECT_FALSE(other->number("rate", rate));
  EXPECT_TRUE(slow->are_valid({"rate"}));
  EXPECT_FALSE(other->are_valid({"rate"})) << "it uses the node's rate, which is wrong";
  slow->refuse_unknown();
  other->refuse_unknown();
  EXPECT_EQ(end_of(node),
            "~rate = 'fast': must be a number\n"
            "~other/rat = 1: unknown parameter, nearest is rate; known are rate");
}

TEST(ParameterReader, TheRemedyDeletesRefusedParametersOnTheMaster) {
  XmlRpcValue tree;
  tree["rate"] = "fast";
  tree["cameras"]["one"]["rat"] = 1;
  ParameterReader node(tree);
  double rate = 50;
  node.number("rate", rate);
  node.fault("source", "must be given");
  auto cameras = node.map("cameras");
  auto one = cameras->map("one");
  one->know("rate");
  one->refuse_unknown();
  std::string text;
  try {
    node.finish();
  } catch (const ParameterError& error) {
    text = error.with_remedy("/crane1/trk_to_ros").what();
  }
  EXPECT_THAT(text, ::testing::StartsWith("~rate = 'fast': must be a number\n~source: must be given\n"));
  EXPECT_THAT(text, ::testing::EndsWith("\nParameters stay on the master when a node ends. To remove those that are "
                                        "refused:\n"
                                        "  rosparam delete /crane1/trk_to_ros/rate\n"
                                        "  rosparam delete /crane1/trk_to_ros/cameras/one/rat"));
}

TEST(ParameterReader, NoRemedyForWhatIsMissing) {
  ParameterReader node{XmlRpcValue()};
  node.fault("source", "must be given");
  EXPECT_EQ(test::error_of<ParameterError>([&] {
              try {
                node.finish();
              } catch (const ParameterError& error) {
                throw error.with_remedy("/node");
              }
            }),
            "~source: must be given");
}

TEST(ParameterReader, IdsOf32Bits) {
  const std::pair<XmlRpcValue, std::uint32_t> valid[] = {
      {0, 0},
      {2147483647, 2147483647},
      {"7", 7},
      {"4294967295", 4294967295},
      {4294967295.0, 4294967295},  // what rosrun makes of _id:=4294967295
  };
  for (const auto& [value, id] : valid) {
    XmlRpcValue tree;
    tree["id"] = value;
    ParameterReader reader(tree);
    std::optional<std::uint32_t> read;
    EXPECT_TRUE(reader.id("id", read)) << id;
    EXPECT_EQ(read, id);
  }
  const std::pair<XmlRpcValue, const char*> wrong[] = {
      {-1, "-1"}, {"4294967296", "'4294967296'"}, {"-1", "'-1'"}, {"", "''"}, {"1 ", "'1 '"}, {1.5, "1.5"},
      {true, "1"}};
  for (const auto& [value, shown_as] : wrong) {
    XmlRpcValue tree;
    tree["id"] = value;
    ParameterReader reader(tree);
    std::optional<std::uint32_t> read;
    EXPECT_FALSE(reader.id("id", read));
    EXPECT_EQ(end_of(reader), std::string("~id = ") + shown_as +
                                  ": must be an integer, 0 to 4294967295; above 2147483647 as text: \"4294967295\"");
  }
}

}  // namespace trk_bridge::ros1::parameter_reader_test
