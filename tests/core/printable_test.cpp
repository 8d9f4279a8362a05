#include "model/core/text/printable.h"

#include <gtest/gtest.h>

namespace choreo::printable_test {

TEST(PrintableTest, KeepsTextAndEscapesControlCharacters) {
  EXPECT_EQ(Printable("pas de bourrée 舞 🕺"), "pas de bourrée 舞 🕺");
  EXPECT_EQ(Printable("\x1b[2Jkick\n\x7f"), "\\x1b[2Jkick\\x0a\\x7f");
  EXPECT_EQ(Printable("a\xc2\x9b"
                      "2J"),
            "a\\xc2\\x9b2J");  // one byte's control sequence in UTF-8
  EXPECT_EQ(Printable("\xff\xe2\x82"), "\\xff\\xe2\\x82");
  EXPECT_EQ(Printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(Printable(""), "");
}

}  // namespace choreo::printable_test
