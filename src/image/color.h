// A color, and those of the films' overlays: Okabe and Ito's, told apart by every kind of color vision, on two grays.
#pragma once

#include <cstdint>

namespace bookspin {

struct Color {
  std::uint8_t r = 0, g = 0, b = 0;  // sRGB
  std::uint8_t a = 255;              // 0 transparent ... 255 opaque
  bool operator==(const Color&) const = default;
};

namespace palette {
inline constexpr Color orange{230, 159, 0, 255};
inline constexpr Color sky{86, 180, 233, 255};
inline constexpr Color green{0, 158, 115, 255};
inline constexpr Color yellow{240, 228, 66, 255};
inline constexpr Color vermilion{213, 94, 0, 255};
inline constexpr Color purple{204, 121, 167, 255};
inline constexpr Color light{236, 239, 244, 255};
inline constexpr Color gray{150, 160, 175, 255};
}  // namespace palette

}  // namespace bookspin
