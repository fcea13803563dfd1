/// One path from the camera: the transport that makes the picture.
#pragma once

#include "transport/path/camera_segment.h"
#include "transport/path/path_offer.h"
#include "transport/sample/grouped_light.h"
#include "transport/sample/path_record.h"
#include "transport/techniques/joint.h"

namespace tyndall {

/// Path tracing with next-event estimation and MIS through surfaces and media [Kajiya 1986; Veach 1997].
/// A value for one sample: make it, run() it, drop it.
class Path {
 public:
  /// What a path may do.
  struct Limits {
    int max_depth;                    ///< bounces, counted as pbrt's volpath does
    bool want_transmittance = false;  ///< record the camera ray's transmittance
    bool want_albedo = false;         ///< and the first bounce's albedo
  };

  Path(const LightContext& context, const Limits& limits, const Ray& camera_ray);

  Path(const Path&) = delete;  // context_ may point into it

  /// Takes note of what choosing lights adds to its noise. Before it runs.
  void observe(LightTrial& trial) { context_.trial = &trial; }

  /// To its end.
  void run();

  /// In place of run(), where paths share what they find beyond their first vertex that spreads light (suffix_reuse.h): the
  /// path goes until it ends, which may be in an environment that others see as well, or stands at a vertex that they do.
  void run_until_offer();
  bool offers() const { return offer_.has_value(); }  ///< else it has nothing to offer
  PathOffer& offer() { return *offer_; }
  const PathOffer& offer() const { return *offer_; }
  /// Where it may receive what others offer, besides: along the camera's ray through media; and on the surface behind them,
  /// which a path that remained there has nothing to offer of. Null: there is none.
  CameraSegment* segment() { return segment_ ? &*segment_ : nullptr; }
  PathOffer* behind();
  /// The rest of a path that stands at a vertex: the light that is scattered there. What others may count too counts only as it
  /// is handed out, by take().
  void complete_offer();
  enum class Received { on_surface, in_medium };
  static Received received_at(const Vertex& first) { return first.on_surface() ? Received::on_surface : Received::in_medium; }
  /// What of a find, its own or another's, the path counts: `factor` times the find's radiance, or times what it sees of an
  /// environment there itself.
  void take(Rgb factor, const Find& find, Received where);
  /// The same of one that it receives in a medium at `t` along the camera's ray, at `vertex`, wherever the path itself
  /// collides.
  void take_at(const Vertex& vertex, float t, Rgb factor, const Find& find);
  /// Work that it has done for other outputs than the picture, which must not depend on them.
  const Counters& work_for_outputs() const { return work_for_outputs_; }
  /// The factor of a find of its own, were it not shared.
  Rgb own_factor(const Find& find) const { return offer_->arrived * find.scattered; }
  /// What the ended path has found.
  PathRecord result();

 private:
  class ScatteredEmission;

  /// What a path draws random numbers for from one bounce to the next.
  enum class Step { gather, fly, light, scatter };
  static constexpr int kSteps = 4;
  void begin(Step step);
  Rng stream_for_emission();

  /// What is behind the media that the camera's ray collides in.
  struct Beyond {
    Ray ray;
    Rgb seen;
    MediaState media;
    Trace trace;
  };
  /// For the light of that alone: the path ends there.
  Path(const Path& camera, const Beyond& beyond);
  PathRecord run_beyond(const Trace& trace);

  std::optional<Vertex> follow(std::optional<Vertex> vertex);
  bool may_offer(const Vertex& first) const;
  bool leaves_first() const;
  bool is_at_find() const;
  bool shares_directions() const;
  bool is_own(int bounces) const;
  bool may_offer_lights(const Vertex& second) const;
  void offer_lights(const Directions& directions);
  bool may_share(const Vertex& first) const;
  const Span& receive_along(Span span, const Trace& trace);
  bool is_offered(const Vertex& second) const;
  bool has_environment() const;
  bool is_environment_offered() const;
  void offer_environment();
  void be_on_camera_ray();
  bool is_environment_sought(const PathOffer& at, Vec3 wi) const;
  Rgb take_environment(Rgb factor, Vec3 wi, PathOffer& at);
  SoughtLights sought_along(const Vertex& vertex, float t) const;
  Rgb environment_from(const PathOffer& offer, LightId light, Vec3 wi) const;
  bool completes_one_direction() const;
  std::optional<Vertex> next_vertex();
  std::optional<Vertex> arrive(const Trace& trace);
  std::optional<Vertex> collide_untraced();
  std::optional<Vertex> pass_media(const Trace& trace);
  std::optional<Rgb> seen_beyond(const Span& span, const Trace& trace);
  void gather(const Span& span);
  bool lit_at_collisions(const Span& span) const;
  bool flies_regularly(MediaView media) const;
  std::optional<Vertex> fly(const Span& span, const Trace& trace);
  void add_volume_emission(const Span& span);
  int bounces_of_light(bool weighed) const;
  void dim(const Span& span);
  bool gather_light(const Directions& directions, Rgb beta);
  Rgb light_at(const Directions& directions, Rgb beta);
  bool look_into_mirror(const Vertex& vertex, Rgb beta);
  float scattering_mis_weight(LightId id, float light_pdf) const;
  Vertex vertex_at(const SurfaceHit& hit, Vec3 wo, const MediaState& media);
  int narrow_to_channel();
  void add_environment();
  void add_surface_emission(const SurfaceHit& hit);
  void add(Rgb contribution, int bounces);
  void add_estimate(Rgb factor, Rgb estimate, int bounces);
  void add_light(LightId light, Rgb contribution, int bounces);
  GroupedLight::Sums& sums_by_group(int bounces);
  void record_camera_ray(const Trace& trace);
  void record_collision(float t);
  void record_transmittance(const Span& span);
  void record_camera_media(const Span& span);
  bool scatter(const Vertex& vertex);
  bool pass_pane(const Vertex& vertex);
  bool may_go_on() const;
  bool go_on(const Vertex& vertex, const ScatterSample& s);
  bool survive_roulette();

  LightContext context_;
  Limits limits_;
  Ray ray_;
  MediaState media_;
  Rgb beta_{1.0f};
  std::optional<Rgb> seen_;     ///< in place of beta_ for the light of what the camera's ray meets at its end
  std::optional<int> channel_;  ///< the only one of beta_ that is not 0: a dispersive surface was met
  int depth_ = 0;               ///< bounces so far
  float eta_scale_ = 1;         ///< undoes the 1/eta^2 of transmissions in Russian roulette
  float before_ = 1;            ///< throughput up to an offer's vertex, where beta_ begins anew: for roulette
  float guided_pdf_ratio_ = 1;  ///< of the path: offsets in roulette that guided paths weigh less
  PathRecord record_;
  Counters work_for_outputs_;
  bool first_bounce_in_medium_ = false;

  // The last bounce, for the MIS weight of emitters that its ray hits.
  bool light_sampled_ = false;                 ///< next-event estimation could have found what this ray finds
  bool end_counted_ = false;                   ///< emitters at the end of this ray count by look_into_mirror()
  int panes_ = 0;                              ///< that the ray has passed since, straight on
  Vec3 from_;                                  ///< its position
  float pdf_ = 0;                              ///< of its direction, 1/sr
  std::optional<CollisionJointWeight> joint_;  ///< the ray from it, if it sampled lights jointly; context_ points to it
  SoughtLights sought_;

  // The span that the path is in.
  std::optional<bool> lit_at_collisions_;  ///< as decided before the ray was traced; else the span decides
  std::optional<SpanSearch> span_search_;
  float collision_t_ = 0, collision_density_ = 0;

  Rgb flown_{1.0f};  ///< weight of the flight since the last bounce that was none at a pane
  enum class Sharing { none, offering, completing };
  Sharing sharing_ = Sharing::none;  ///< whether an offer is still ahead, or what it is worth is being found
  bool in_mirror_ = false;           ///< of the surface of its find: what comes from there others do not see
  std::optional<PathOffer> offer_;
  std::optional<CameraSegment> segment_;
  std::optional<SpanSearch> camera_search_;  ///< of the segment's lights, where it may receive of environments
  std::optional<PathOffer> behind_;

  std::optional<Beyond> beyond_;  ///< what this path, which collided, leaves to another
};

}  // namespace tyndall
