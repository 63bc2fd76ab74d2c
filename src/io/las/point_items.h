// Decodes the parts of points. In the point formats 0 to 5, one arithmetic decoder reads all parts, point by
// point. In the formats 6 to 10, each part has its own decoder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "io/las/arithmetic_decoder.h"

namespace relievo::io {

// Decodes one part of each point. Unused parts must be decoded, too, because other parts follow them in the
// same stream.
class PointItem {
 public:
  PointItem() = default;
  PointItem(const PointItem&) = delete;
  PointItem& operator=(const PointItem&) = delete;
  virtual ~PointItem() = default;

  virtual void start(const char* raw) = 0;  // begins with the first point, which is not compressed
  virtual void next(ArithmeticDecoder& decoder) = 0;
};

using LazColour = std::array<std::uint16_t, 3>;

// Decodes colours, which are stored as differences from the previous colour. The layers of formats 6 to 10
// store colours in the same form.
class ColourModels {
 public:
  ColourModels() : bytes_(6, SymbolModel(256)) {}
  void next(ArithmeticDecoder& decoder, LazColour& colour);

 private:
  std::uint8_t byte(ArithmeticDecoder& decoder, std::size_t which, int prediction);

  SymbolModel changes_{128};
  std::vector<SymbolModel> bytes_;
};

class ColourItem : public PointItem {
 public:
  void start(const char* raw) override;
  void next(ArithmeticDecoder& decoder) override { models_.next(decoder, colour_); }
  const LazColour& colour() const { return colour_; }

 private:
  LazColour colour_{};
  ColourModels models_;
};

// Decodes the first 20 bytes of a point, which include the coordinates, the intensity and the returns.
class PositionItem : public PointItem {
 public:
  void start(const char* raw) override;
  void next(ArithmeticDecoder& decoder) override;
  const std::array<std::int32_t, 3>& position() const { return position_; }
  unsigned classification() const { return classification_ & 31U; }
  bool is_withheld() const { return (classification_ & 128U) != 0; }

 private:
  // Models for a byte that changes from point to point: one model per previous value.
  class ByteModels {
   public:
    void next(ArithmeticDecoder& decoder, std::uint8_t& value);

   private:
    std::map<std::uint8_t, SymbolModel> models_;
  };

  void decode_attributes(ArithmeticDecoder& decoder, std::uint32_t changes);
  std::size_t return_context() const;

  std::array<std::int32_t, 3> position_{};
  std::uint8_t returns_ = 0, classification_ = 0, user_data_ = 0;
  std::uint16_t source_ = 0;
  std::array<std::uint16_t, 16> intensities_{};
  std::array<std::int32_t, 8> heights_{};
  std::array<RunningMedian, 16> median_x_, median_y_;

  SymbolModel changes_{64};
  ByteModels returns_models_, classification_models_, user_data_models_;
  std::array<SymbolModel, 2> angle_models_{SymbolModel(256), SymbolModel(256)};
  IntegerDecoder intensity_{16, 4}, source_decoder_{16, 1};
  IntegerDecoder x_{32, 2}, y_{32, 22}, z_{32, 20};
};

class TimeItem : public PointItem {
 public:
  void start(const char* raw) override;
  void next(ArithmeticDecoder& decoder) override;

 private:
  // Times belong to up to four sequences. Each has a usual step.
  struct Sequence {
    std::uint64_t time = 0;
    std::int32_t step = 0;
    int extremes = 0;
  };

  bool decode_first_step(ArithmeticDecoder& decoder);
  bool decode_multiple(ArithmeticDecoder& decoder);
  void decode_whole(ArithmeticDecoder& decoder);

  std::array<Sequence, 4> sequences_{};
  std::size_t now_ = 0, newest_ = 0;
  SymbolModel multiples_{516}, first_steps_{6};
  IntegerDecoder steps_{32, 9};
};

class WavePacketItem : public PointItem {
 public:
  void start(const char* raw) override;
  void next(ArithmeticDecoder& decoder) override;

 private:
  std::int32_t offset_step_ = 0, size_ = 0, return_point_ = 0;
  std::array<std::int32_t, 3> direction_{};
  std::uint32_t offset_kind_ = 0;
  SymbolModel index_{256};
  std::vector<SymbolModel> offset_kinds_{4, SymbolModel(4)};
  IntegerDecoder offset_{32, 1}, size_decoder_{32, 1}, return_decoder_{32, 1}, direction_decoder_{32, 3};
};

class ExtraBytesItem : public PointItem {
 public:
  explicit ExtraBytesItem(std::size_t count) : models_(count, SymbolModel(256)) {}
  void start(const char*) override {}
  void next(ArithmeticDecoder& decoder) override {
    for (SymbolModel& model : models_) decoder.symbol(model);
  }

 private:
  std::vector<SymbolModel> models_;
};

// Points of the formats 6 to 10. Coordinates and colours of a chunk are in separate layers, each with its own
// decoder. Unused layers are skipped.

// The layers that are read. Each layer except xy is empty if all points of the chunk have the value of the
// first point.
struct LazLayers {
  std::string_view xy, z, classes, flags, colours;
  // In version 3, some colours of a scanner are stored as differences from those of another scanner; later
  // versions corrected that.
  bool are_colours_mixed = false;
};

class LayeredPoint {
 public:
  // `first` points to the 30 bytes of the first point, which is not compressed. `colour` points to its
  // colour, or is null.
  LayeredPoint(const LazLayers& layers, const char* first, const char* colour);
  void next();

  const std::array<std::int32_t, 3>& position() const { return channels_[channel_]->position; }
  unsigned classification() const { return channels_[channel_]->classification; }
  bool is_withheld() const { return (channels_[channel_]->flags & 4U) != 0; }
  const LazColour& colour() const { return colour_; }
  bool is_beyond_end() const {
    const auto is_beyond = [](const auto& layer) { return layer && layer->is_beyond_end(); };
    return xy_.is_beyond_end() || is_beyond(z_) || is_beyond(classes_) || is_beyond(flags_) ||
           is_beyond(colours_);
  }

 private:
  // The points of a file are from up to four scanners, which have separate models.
  struct Channel {
    std::array<std::int32_t, 3> position{};
    std::uint32_t return_number = 0, return_count = 0;
    std::uint32_t classification = 0, flags = 0;
    bool has_new_time = false;
    std::array<RunningMedian, 12> median_x, median_y;
    std::array<std::int32_t, 8> heights{};
    std::vector<SymbolModel> changes{8, SymbolModel(128)};
    SymbolModel channel_step{3}, return_step{13};
    std::array<std::optional<SymbolModel>, 16> return_counts, return_numbers;
    std::array<std::optional<SymbolModel>, 64> classes, flag_sets;
    IntegerDecoder x{32, 2}, y{32, 22}, z{32, 20};
  };
  struct ColourChannel {
    LazColour last{};
    ColourModels models;
  };

  std::uint32_t decode_changes();
  void decode_returns(Channel& channel, std::uint32_t changes);
  void decode_position(Channel& channel);
  void decode_class(Channel& channel);
  void decode_colour(bool changes_scanner);

  ArithmeticDecoder xy_;
  std::optional<ArithmeticDecoder> z_, classes_, flags_, colours_;
  bool are_colours_mixed_;
  std::size_t channel_ = 0, colour_channel_ = 0;
  std::array<std::unique_ptr<Channel>, 4> channels_;
  std::array<std::unique_ptr<ColourChannel>, 4> colour_channels_;
  LazColour colour_{};
};

}  // namespace relievo::io
