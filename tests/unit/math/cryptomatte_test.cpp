#include "tyndall/cryptomatte.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>

#include "tyndall/utf8.h"

using namespace tyndall;

TEST_CASE("ids are the hashes of the specification's examples") {
  CHECK(murmur_hash("") == 0);
  CHECK(murmur_hash("hello") == 0x248bfa47);
  CHECK(matte_id("hello") == 0x248bfa47);
  CHECK(matte_id("cube") == 0xd9682f08);
  CHECK(matte_id("sphere") == 0x591e9a8d);
  CHECK(matte_id("bunny") == 0x13851a76);
  CHECK(matte_id("default") == 0x42c9679f);
}

TEST_CASE("every length of text is hashed to its last byte") {
  const std::string text = "\xff\x80the quick brown fox";
  for (std::size_t length = 1; length <= text.size(); ++length) {
    CAPTURE(length);
    std::string other = text.substr(0, length);
    const std::uint32_t hash = murmur_hash(other);
    for (std::size_t i = 0; i < length; ++i) {
      other[i] = static_cast<char>(other[i] ^ 1);
      CHECK(murmur_hash(other) != hash);
      other[i] = static_cast<char>(other[i] ^ 1);
    }
    CHECK(murmur_hash(other) == hash);
  }
  CHECK(murmur_hash("The quick brown fox jumps over the lazy dog") == 0x2e4ff723);
}

TEST_CASE("ids are normal floats: an exponent of 0 or 255 has its lowest bit turned") {
  CHECK(murmur_hash("n17") == 0x000738c5);
  CHECK(matte_id("n17") == 0x008738c5);
  CHECK(murmur_hash("n535") == 0xff8d97ef);
  CHECK(matte_id("n535") == 0xff0d97ef);
  for (int i = 0; i < 20000; ++i) CHECK(std::isnormal(std::bit_cast<float>(matte_id("n" + std::to_string(i)))));
}

TEST_CASE("a manifest is JSON that names each id, and the header tells where it is") {
  const MatteNames names{{"b", 0x00000010}, {"a \"quoted\" \\ name\n", 0xd9682f08}, {"b", 0x00000010}};
  CHECK(manifest_text(names) == R"({"a \"quoted\" \\ name\u000a":"d9682f08","b":"00000010"})");
  CHECK(manifest_text({}) == "{}");
  Image image;
  describe_mattes(image, "CryptoObject", names);
  char key[9];
  std::snprintf(key, sizeof key, "%08x", murmur_hash("CryptoObject"));
  const std::string prefix = "cryptomatte/" + std::string(key, 7) + "/";
  const auto text = [&](const char* name) { return *image.attribute<std::string>(prefix + name); };
  CHECK(text("name") == "CryptoObject");
  CHECK(text("hash") == "MurmurHash3_32");
  CHECK(text("conversion") == "uint32_to_float32");
  CHECK(text("manifest") == manifest_text(names));
  CHECK(manifest_attribute("CryptoObject") == prefix + "manifest");
  CHECK(manifest_attribute("CryptoMaterial") != prefix + "manifest");
}

TEST_CASE("a pixel keeps the six largest, in their order, and reads them back") {
  Image image;
  image.data = image.display = {0, 0, 2, 1};
  MatteWriter writer(image, "CryptoMedium");
  CHECK(image.channels.size() == 12);
  CHECK(has_mattes(image, "CryptoMedium"));
  CHECK_FALSE(has_mattes(image, "CryptoObject"));
  for (const Channel& c : image.channels) CHECK(is_matte_channel(c.name));
  CHECK(image.find("CryptoMedium00.R"));
  CHECK(image.find("CryptoMedium02.A"));
  CHECK_FALSE(is_matte_channel("R"));
  CHECK_FALSE(is_matte_channel("Sum.CryptoMedium.0.key"));
  std::vector<MatteCoverage> covers;
  for (std::uint32_t i = 0; i < 8; ++i) covers.push_back({0x3f800000 + i, i == 3 ? -0.1f : 0.01f * static_cast<float>(i % 4)});
  writer.set(1, covers);
  const MatteReader reader(image, "CryptoMedium");
  CHECK(reader.at(0).empty());
  const auto found = reader.at(1);
  // Coverages 0, 0.01, 0.02, -0.1, 0, 0.01, 0.02, 0.03
  REQUIRE(found.size() == 5);
  const std::vector<std::uint32_t> expected{7, 2, 6, 1, 5};
  for (std::size_t i = 0; i < found.size(); ++i) CHECK(found[i].id == 0x3f800000 + expected[i]);
  CHECK(image.find("CryptoMedium00.G")->values[1] == 0.03f);
  CHECK(std::bit_cast<std::uint32_t>(image.find("CryptoMedium00.B")->values[1]) == 0x3f800002);
  for (MatteCoverage& c : covers) c.coverage = 0.1f;
  writer.set(1, covers);
  CHECK(reader.at(1).size() == kMatteRanks);
  CHECK(reader.at(1)[5].id == 0x3f800005);
}

TEST_CASE("what is no UTF-8 of a name becomes U+FFFD, the rest stays") {
  CHECK(valid_utf8("table") == "table");
  CHECK(valid_utf8("\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80") == "\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80");
  CHECK(valid_utf8("a\xff"
                   "b\xc3") ==
        "a\xef\xbf\xbd"
        "b\xef\xbf\xbd");
}
