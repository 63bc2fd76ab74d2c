// Draws the model that the page shows: makes its frames and pictures, and returns facts about them.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/wording.h"
#include "relievo/job.h"
#include "relievo/ornament_places.h"
#include "relievo/picture/preview.h"
#include "studio/piece.h"

namespace relievo::app::studio {

// Facts about a model, which stay the same while the page shows that model.
struct ModelFacts {
  ScanReport scan = {};
  std::size_t points = 0, triangles = 0, hull = 0;
  // The size and lower left corner of the relief's box, relative to Surface::centre, in units of the scan.
  Vec2 size = Vec2::Zero(), corner = Vec2::Zero();
  Vec2 origin = Vec2::Zero();  // the same corner in the coordinates of the scan, turned into the view
  double delta = 0;
  Mat3 rotation = Mat3::Identity();
  bool has_colours = false;            // whether the scan's points have colours
  bool can_be_lit = false;             // whether slopes can be chosen for one light
  std::vector<Remark> remarks;         // each text is a full sentence
  std::vector<std::size_t> histogram;  // element i: number of points with i <= size * sqrt(|k|) < i + 1
};

// The fractions of a slope, from 0 to 1, that a relief keeps at different curvatures k. Element i of a vector
// is the fraction at sqrt(|k|) = i / (size - 1). The page draws these samples as the tone curve.
struct CurveSamples {
  static constexpr std::size_t size = 81;

  std::vector<double> share;  // the fraction that the saturation or the tone curve sets
  std::vector<double> kept;   // the fraction in a relief of this height; equals `share` in the layered style
};

struct PictureRequest {
  ReliefOptions options;  // the view of these options is ignored
  std::optional<double>
      draft_limit_mm;  // largest height that the draft angle allows; empty without an angle, or if unknown
  std::optional<View> turned;   // the view while the user turns the model; empty: the prepared view
  std::optional<double> u;      // strength of the compression; empty if the height is given
  bool is_original = false;     // draw the model itself instead of its relief
  bool is_at_rest = false;      // the user pauses: draw the exact height; a newer request cancels this one
  bool is_finished = false;     // draw the piece exactly as it is exported
  bool has_attention = false;   // colour the model itself by its attention, see attention()
  bool is_drawn_apart = false;  // return a frame without drawing it, see PictureAnswer::undrawn
  std::optional<Error> ornament_error = {};       // the reason why the ornaments were left out
  RenderOptions render;                           // its lengths are replaced by those of `options`
  std::shared_ptr<const Progress> progress = {};  // null if the picture cannot be cancelled
};

// A frame that a FrameRenderer of the model can draw. The arrays of `shown` are valid until the next picture.
struct UndrawnFrame {
  std::shared_ptr<const ReliefModel> model;
  std::size_t number = 0;  // counts the model's frames; equal numbers mean equal heights
  Shown shown;
  RenderOptions render;
};

struct PictureAnswer {
  Picture picture;
  std::optional<UndrawnFrame> undrawn;  // set instead of `picture` if the frame is drawn elsewhere
  bool is_finished = false;             // the picture shows the piece as it is exported, or the model itself
  bool is_plain = false;                // the piece is a relief on a rectangular plate without ornaments
  bool has_ornaments = false;           // whether the picture shows the ornaments of the options
  std::optional<Error> ornament_error = {};  // copied from the request
  double drawing_s = 0;
  double width_mm = 0;                  // the longer side of the relief
  Vec3 size_mm = Vec3::Zero();          // the size of the piece
  bool is_size_exact = false;           // whether the exported piece has exactly this size
  std::optional<double> most_width_mm;  // largest width_mm with which the relief fits the plate
  std::optional<std::array<Vec2, 2>>
      relief_mm;  // lower left and upper right corner of the relief, from the piece's centre; empty if bent

  // The share of the front's area that the milling tool can reach, and the greatest depth of material that it leaves.
  struct Reach {
    double share = 1, left_mm = 0;
  };
  std::optional<Reach> reach;  // empty without a tool

  // The members below describe how the relief was made. In a picture of the model itself they have their
  // defaults.
  Compression compression;      // the compression that the engine found
  double height_mm = 0;         // the height option with which the file is made
  double relief_height_mm = 0;  // height of the relief in the file; lower if the tool leaves material
  bool is_height_met = true;
  FrameTimes times;
  CurveSamples curve;
};

// A piece and the renderer that draws it.
struct DrawnPiece {
  ReliefOptions options;  // the options with which the piece was made
  std::shared_ptr<const Solid> solid;
  std::shared_ptr<const ToolReach> reach;  // the reach of the tool in the options; null without a tool
  SolidRenderer renderer;
  // See relief_height_mm(). A coarse piece has it only with the option mm-per-value.
  std::optional<double> height_mm = {};
};

// The height of a piece, and whether it equals the requested height.
struct PieceHeight {
  double mm = 0;
  bool is_met = true;
};

// If ornaments caused the error, removes them from the request, stores the error in the request, and returns
// true. Otherwise returns false.
bool leave_out_ornaments(PictureRequest& request, const Error& error);

// Reads the files of the request's ornaments. If one cannot be read, removes the ornaments from the request and
// stores the error in it.
void read_ornaments_of(PictureRequest& request);

// Draws one model. Not for concurrent use.
class Drawing {
 public:
  // Shares ownership of the model. If the model has fewer points than the scan, `shown` also has the detail that
  // these points cannot represent. `outliers` is the number of outliers that were left out of the scan; `remarks`
  // are the other remarks on the scan.
  Drawing(ShownModel shown, std::size_t outliers, std::vector<std::string> remarks = {});

  const ModelFacts& facts() const { return facts_; }

  // While the drawing is frozen, it shows the last frame, if there is one, instead of the requested frame.
  void freeze(bool is_frozen) { is_frozen_ = is_frozen; }

  // Draws one of the following:
  // - the model itself, if the request asks for it;
  // - the finished piece, if take() has received it. A plain piece (see PictureAnswer::is_plain) is drawn in
  //   this way only if the request asks for the finished piece. Only finished pieces have ornaments, and the
  //   effects of a draft angle, a simplification and a tool;
  // - a frame on its plate. Its height is exact at rest, and within 3 % of the requested height while a
  //   slider moves;
  // - a coarse piece, which has fewer samples than the finished one, where frames are impossible: for
  //   lithophanes, for depths in mm, and for bent reliefs without ground.
  // Errors: those of make_relief().
  Result<PictureAnswer> picture(PictureRequest request);

  // Returns the options of the piece that the picture of this request needs; nothing if take() has received
  // that piece. Errors: those of with_width().
  Result<std::optional<ReliefOptions>> missing_piece(PictureRequest request);

  // Returns where the ornaments of the options lie. Errors: those of relievo::ornament_places().
  Result<std::vector<OrnamentPlace>> ornament_places(const ReliefOptions& options) const;

  // Keeps the finished piece, which was made with these options, until the next call.
  void take(std::shared_ptr<const MadeRelief> made, const ReliefOptions& options);

  // Returns the greatest height of the relief, in mm, that the options allow; see LiveModel::highest_mm().
  // Errors: those of with_width().
  Result<double> reachable_height(const ReliefOptions& options);

  // Returns heights above the ground, in mm, along a line in the front view: the heights of the model if the
  // request asks for the model, the heights of the relief if the piece is a relief on a rectangular plate,
  // and otherwise the heights of the piece that picture() draws. Errors: those of picture().
  Result<std::vector<float>> profile(PictureRequest request, const SectionLine& line);

 private:
  PieceHeight height_of(const PictureRequest& request, const LiveFrame& made) const;
  LiveFrame frame(const PictureRequest& request, bool is_exact);
  std::optional<std::array<Vec2, 2>> relief_in(const Solid& solid, const ReliefOptions& options) const;
  ReliefOptions piece_options(const PictureRequest& request, const LiveFrame& made) const;
  bool is_finished(const ReliefOptions& options) const { return finished_ && finished_->options == options; }
  Result<DrawnPiece*> piece(const ReliefOptions& options);
  std::span<const float> attention();
  Result<void> draw_frame(const PictureRequest& request, const RenderOptions& render, const LiveFrame& made,
                          PictureAnswer& answer);
  Result<void> draw(const PictureRequest& request, const RenderOptions& render, const LiveFrame& made,
                    PictureAnswer& answer);

  ModelFacts facts_;
  std::shared_ptr<const ReliefModel> model_;
  LiveModel live_;
  std::optional<DrawnPiece> finished_, coarse_;
  std::vector<float> attention_;  // attention of the model; empty until a picture shows it
  std::size_t frames_made_ = 0;
  bool is_frozen_ = false;
};

}  // namespace relievo::app::studio
