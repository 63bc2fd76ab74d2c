// Points of the formats 6 to 10: coordinates and colours of a chunk are in separate layers, each with its own
// decoder. Unused layers are skipped.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "io/las/point_items.h"

namespace relievo::io {

// The layers that are read. The layer of z or of colours is empty if the whole chunk has the value of its
// first point.
struct PointLayers {
  std::string_view xy, z, colours;
  // In version 3, some colours of a scanner are stored as differences to another scanner's; later versions
  // have corrected this.
  bool are_colours_mixed = false;
};

class LayeredPoint {
 public:
  // `first` are the 30 bytes of the first point, which is not compressed. `colour` is its colour, or null.
  LayeredPoint(const PointLayers& layers, const char* first, const char* colour);
  void next();

  const std::array<std::int32_t, 3>& position() const { return channels_[channel_]->position; }
  const LazColour& colour() const { return colour_; }
  bool is_beyond_end() const {
    return xy_.is_beyond_end() || (z_ && z_->is_beyond_end()) || (colours_ && colours_->is_beyond_end());
  }

 private:
  // The points of a file come from up to four scanners, which have separate models.
  struct Channel {
    std::array<std::int32_t, 3> position{};
    std::uint32_t return_number = 0, return_count = 0;
    bool has_new_time = false;
    std::array<RunningMedian, 12> median_x, median_y;
    std::array<std::int32_t, 8> heights{};
    std::vector<SymbolModel> changes{8, SymbolModel(128)};
    SymbolModel channel_step{3}, return_step{13};
    std::array<std::optional<SymbolModel>, 16> return_counts, return_numbers;
    IntegerDecoder x{32, 2}, y{32, 22}, z{32, 20};
  };
  struct ColourChannel {
    LazColour last{};
    ColourModels models;
  };

  std::uint32_t decode_changes();
  void decode_returns(Channel& channel, std::uint32_t changes);
  void decode_position(Channel& channel);
  void decode_colour(bool changes_scanner);

  ArithmeticDecoder xy_;
  std::optional<ArithmeticDecoder> z_, colours_;
  bool are_colours_mixed_;
  std::size_t channel_ = 0, colour_channel_ = 0;
  std::array<std::unique_ptr<Channel>, 4> channels_;
  std::array<std::unique_ptr<ColourChannel>, 4> colour_channels_;
  LazColour colour_{};
};

}  // namespace relievo::io
