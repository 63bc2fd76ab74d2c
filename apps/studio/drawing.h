// Draws the model that is shown: makes its frames and pictures, and returns facts about it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/wording.h"
#include "relievo/job.h"
#include "relievo/picture/preview.h"
#include "studio/solid_section.h"

namespace relievo::app::studio {

// Facts about a model that stay true while it is shown.
struct ModelFacts {
  ScanReport scan = {};
  std::size_t points = 0, triangles = 0, hull = 0;
  Vec2 size = Vec2::Zero(), corner = Vec2::Zero();  // the relief's box, in the scan's units
  Vec2 origin = Vec2::Zero();  // the box's lower left corner, in the scan's coordinates turned into the view
  double delta = 0;
  Mat3 rotation = Mat3::Identity();
  std::vector<Remark> remarks;         // each text is a sentence
  std::vector<std::size_t> histogram;  // histogram of sqrt(|k|) for the curvatures k, from 0 to 1
};

// The fraction of a slope that a relief keeps, from 0 to 1, at curvatures k with sqrt(|k|) = i / (size - 1).
// The page draws these samples as the tone curve.
struct CurveSamples {
  static constexpr std::size_t size = 81;

  std::vector<double> share;  // the fraction that saturation or tone curve ask for
  std::vector<double> kept;   // the fraction in the relief of this height; with layers the same as `share`
};

struct PictureRequest {
  ReliefOptions options;  // its view is ignored
  std::optional<double>
      draft_limit_mm;  // largest height under the draft angle; empty without a draft angle, or while unknown
  std::optional<View>
      turned;                // the view to show while the user turns the model, instead of the prepared view
  std::optional<double> u;   // strength of the compression, if it is given instead of a height
  bool is_original = false;  // shows the model itself in place of its relief
  bool is_finished = false;  // shows the piece as export makes it
  RenderOptions render;      // its lengths are set from the options
  std::shared_ptr<const Progress> progress = {};  // null if the picture cannot be cancelled
};

struct PictureAnswer {
  Picture picture;
  bool is_finished = false;  // shows the piece as export makes it, or the model itself
  bool is_plain = false;     // the piece is a relief on a rectangular plate, which frames show, too
  double drawing_s = 0;
  double width_mm = 0;                  // the relief's longer side
  Vec3 size_mm = Vec3::Zero();          // the piece's size
  bool is_size_exact = false;           // whether the file has this size; that of a coarse piece may differ
  std::optional<double> most_width_mm;  // largest width_mm that fits into the requested plate
  std::optional<std::array<Vec2, 2>>
      relief_mm;  // corners of the relief's box, relative to the middle of the piece; empty if bent

  // The share of the front that the tool reaches, and the most material that it leaves.
  struct Reach {
    double share = 1, left_mm = 0;
  };
  std::optional<Reach> reach;  // empty without a tool

  // The members below describe how the relief was made. A picture of the model itself leaves them at their
  // defaults.
  Compression compression;      // found by the engine
  double height_mm = 0;         // the height to make the file with
  double relief_height_mm = 0;  // of the relief in the file; differs from height_mm if a tool leaves material
  bool is_height_met = true;
  FrameTimes times;
  CurveSamples curve;
};

// A piece with its renderer.
struct DrawnPiece {
  ReliefOptions options;  // by which it was made
  std::shared_ptr<const Solid> solid;
  std::shared_ptr<const ToolReach> reach;  // of the options' tool; null without one
  SolidRenderer renderer;
  // See relief_height_mm(); of a coarse piece only if one vertical scale gives it.
  std::optional<double> height_mm = {};
};

// The height of a piece, and whether it is the requested one.
struct PieceHeight {
  double mm = 0;
  bool is_met = true;
};

// Not for concurrent use.
class Drawing {
 public:
  // Shares the model. If the model has fewer points than the scan, `shown` also has the detail that the
  // model's points do not resolve. `outliers` is the number of outliers that were left out of the scan, and
  // `remarks` are the other remarks on the scan.
  Drawing(TurnedRelief shown, std::size_t outliers, std::vector<std::string> remarks = {});

  const ModelFacts& facts() const { return facts_; }

  // While frozen, pictures show the last frame instead of the requested one, until another model is drawn.
  void freeze(bool is_frozen) { is_frozen_ = is_frozen; }

  // Draws the model itself if the request asks for it, otherwise the relief or its piece. If the options ask
  // only for the relief on a rectangular plate, draws a frame: in fine pictures the relief has exactly the
  // requested height, in others within 3 % of it. The finished piece replaces the frame if the request asks
  // for the piece and take() got it. For other options draws a piece, always for exactly the requested
  // height: the finished piece if take() got it, else a coarse one, which is made faster, with fewer samples
  // and without a draft angle or tool. Errors: those of make_relief().
  Result<PictureAnswer> picture(PictureRequest request);

  // Returns the options of the piece that the request would show; nothing if take() was called with this
  // piece. Errors: those of with_width().
  Result<std::optional<ReliefOptions>> missing_piece(PictureRequest request);

  // Keeps the finished piece that was made with these options, until the next one is taken.
  void take(std::shared_ptr<const MadeRelief> made, const ReliefOptions& options);

  // Returns the height in mm of the highest relief that the options allow, see LiveModel::highest_mm().
  // Errors: those of with_width().
  Result<double> reachable_height(const ReliefOptions& options);

  // Returns heights above the ground in mm along a line in the picture from the front. They are those of the
  // model itself if the request asks for it, of the relief if it is on a rectangular plate, and otherwise of
  // the piece that picture() draws. Errors: those of picture().
  Result<std::vector<float>> profile(PictureRequest request, const SectionLine& line);

 private:
  PieceHeight height_of(const PictureRequest& request, const LiveFrame& made) const;
  LiveFrame frame(const PictureRequest& request, bool is_exact);
  std::optional<std::array<Vec2, 2>> relief_in(const Solid& solid, const ReliefOptions& options) const;
  ReliefOptions piece_options(const PictureRequest& request, const LiveFrame& made) const;
  bool is_finished(const ReliefOptions& options) const { return finished_ && finished_->options == options; }
  Result<DrawnPiece*> piece(const ReliefOptions& options);
  Result<void> draw(const PictureRequest& request, const RenderOptions& render, const LiveFrame& made,
                    PictureAnswer& answer);

  ModelFacts facts_;
  std::shared_ptr<const ReliefModel> model_;
  LiveModel live_;
  std::optional<DrawnPiece> finished_, coarse_;
  bool is_frozen_ = false;
};

}  // namespace relievo::app::studio
