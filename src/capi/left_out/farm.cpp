// This stands for crt_farm, so that the C interface has all of its functions without it.
#include "crt/farm.hpp"
#include "text/left_out.hpp"

namespace crt {

namespace {

[[noreturn]] void refuse_job() {
  throw Error(ErrorCode::unsupported, text::left_out("jobs for many machines", "FARM"));
}

}  // namespace

FarmPlan plan_farm(const std::filesystem::path&, const std::filesystem::path&, const FarmOptions&) {
  refuse_job();
}

FarmPlan read_farm_plan(const std::filesystem::path&) {
  refuse_job();
}

bool work_farm(const std::filesystem::path&, int, const FarmWorkOptions&) {
  refuse_job();
}

std::filesystem::path frame_path(const std::filesystem::path&, int) {
  refuse_job();
}

FarmMerge merge_farm(const std::filesystem::path&, const FarmMergeOptions&) {
  refuse_job();
}

FarmStatus farm_status(const std::filesystem::path&) {
  refuse_job();
}

Image farm_sheet(const std::filesystem::path&, int) {
  refuse_job();
}

int FarmStatus::count(FarmTaskState) const {
  refuse_job();
}

double FarmStatus::share() const {
  refuse_job();
}

double FarmStatus::seconds_spent() const {
  refuse_job();
}

double FarmStatus::seconds_left() const {
  refuse_job();
}

}  // namespace crt
