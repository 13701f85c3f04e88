// Keeps transforms whose stamps are wrong from a tf buffer, which would stop there, and follows clocks that were set.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace trk_bridge::bridge {

/// A stamp that does not continue those before it.
struct StampJump {
  enum class Kind : std::uint8_t {
    ahead,          ///< of ROS time
    back,           ///< behind the link's own clock
    ros_time_back,  ///< the clock of ROS itself: of no link
  };
  Kind kind = Kind::ahead;
  std::string frame;   ///< the link's child
  std::string sender;  ///< the node that published it
  double seconds = 0;  ///< how far, more than 0
};
std::string describe(const StampJump&);

/// Jumps of the links that the pose depends on.
struct TransformGateStatistics {
  std::uint64_t refused = 0;  ///< transforms
  StampJump last_refused;
  std::uint64_t restarts = 0;  ///< clocks that were followed
  StampJump last_restart;
};

/// One transform of tf. Stamp in ns since 1970. Texts are the caller's.
struct StampedLink {
  std::string_view parent, child;
  std::int64_t stamp = 0;
  std::string_view sender;
};

/// Judges every transform before it gets into a tf buffer. A buffer holds the newest 10 s: one transform that lies far
/// ahead removes the others of its link and has all later ones refused, and so does a clock that is set back.
/// A stamp may lie up to 1 s ahead of ROS time, or of where its link's own clock is by now, and 1 s behind the link's
/// newest. Other transforms are refused. Where nothing else has come on their link for `patience`, its clock was set:
/// then the buffer has to start over, and the new clock counts. Not synchronised: one thread at a time.
class TransformGate {
 public:
  enum class Verdict : std::uint8_t {
    use,
    refuse,
    restart,  ///< empty the buffer of all but static transforms, then use it
  };
  /// ns, of a jump that is followed; with what a link's period adds it costs less than 1 s of poses.
  static constexpr std::int64_t patience = 300'000'000;

  /// The pose is that of `camera_frame` in `studio_frame`.
  TransformGate(std::string studio_frame, std::string camera_frame);

  /// A link that no stamp belongs to.
  void add_static(std::string_view parent, std::string_view child) { link_of(parent, child); }
  /// Whether ROS time, `ros_now`, has gone back by more than 1 s since the last call: then the buffer has to start
  /// over. To be asked before judge().
  bool ros_time_went_back(std::int64_t ros_now);
  /// `ros_now` is ROS time, `now` the steady clock, both ns. Allocates only for links that are new, and for jumps.
  Verdict judge(const StampedLink&, std::int64_t ros_now, std::int64_t now);

  const TransformGateStatistics& statistics() const noexcept { return statistics_; }

 private:
  struct Link {
    std::string parent;
    std::optional<std::int64_t> newest;         // stamp
    std::int64_t newest_at = 0;                 // when it came, steady clock
    std::optional<std::int64_t> refused_since;  // steady clock, of those that came since the last sound one
  };

  Link& link_of(std::string_view parent, std::string_view child);
  std::optional<StampJump> jump_of(const Link&, const StampedLink&, std::int64_t ros_now, std::int64_t now) const;
  bool pose_depends_on(const Link&) const;
  void start_over(const StampJump&);

  const std::string studio_frame_, camera_frame_;
  std::map<std::string, Link, std::less<>> links_;  // by their child
  std::int64_t ahead_ = 0;                          // ns, of the clock that was followed, over ROS time
  std::int64_t last_ros_now_ = 0;
  TransformGateStatistics statistics_;
};

}  // namespace trk_bridge::bridge
