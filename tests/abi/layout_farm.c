// This is the layout of what jobs for many machines have in crt.h; see layout.c.
#include "layout.h"

SIZE(crt_farm_options, 64);
AT(crt_farm_options, struct_size, 0);
AT(crt_farm_options, has_frames, 4);
AT(crt_farm_options, first_frame, 8);
AT(crt_farm_options, last_frame, 12);
AT(crt_farm_options, tasks, 16);
AT(crt_farm_options, tile_width, 20);
AT(crt_farm_options, tile_height, 24);
AT(crt_farm_options, reserved, 28);
AT(crt_farm_options, least_seconds, 32);
AT(crt_farm_options, script, 40);
AT(crt_farm_options, render, 48);
AT(crt_farm_options, max_primitives, 56);

SIZE(crt_farm_job, 56);
AT(crt_farm_job, struct_size, 0);
AT(crt_farm_job, tasks, 4);
AT(crt_farm_job, has_frames, 8);
AT(crt_farm_job, first_frame, 12);
AT(crt_farm_job, last_frame, 16);
AT(crt_farm_job, width, 20);
AT(crt_farm_job, height, 24);
AT(crt_farm_job, passes, 28);
AT(crt_farm_job, has_channels, 32);
AT(crt_farm_job, reserved, 36);
AT(crt_farm_job, seconds, 40);
AT(crt_farm_job, longest_seconds, 48);

SIZE(crt_farm_work_options, 24);
AT(crt_farm_work_options, struct_size, 0);
AT(crt_farm_work_options, threads, 4);
AT(crt_farm_work_options, progress, 8);
AT(crt_farm_work_options, progress_user, 16);

SIZE(crt_farm_merge_options, 64);
AT(crt_farm_merge_options, struct_size, 0);
AT(crt_farm_merge_options, reserved, 4);
AT(crt_farm_merge_options, output, 8);
AT(crt_farm_merge_options, skip, 16);
AT(crt_farm_merge_options, skip_count, 24);
AT(crt_farm_merge_options, report, 32);
AT(crt_farm_merge_options, report_user, 40);
AT(crt_farm_merge_options, poll, 48);
AT(crt_farm_merge_options, poll_user, 56);

SIZE(crt_farm_progress, 48);
AT(crt_farm_progress, struct_size, 0);
AT(crt_farm_progress, waiting, 4);
AT(crt_farm_progress, running, 8);
AT(crt_farm_progress, lost, 12);
AT(crt_farm_progress, done, 16);
AT(crt_farm_progress, reserved, 20);
AT(crt_farm_progress, share, 24);
AT(crt_farm_progress, seconds_spent, 32);
AT(crt_farm_progress, seconds_left, 40);

SIZE(crt_farm_task, 160);
AT(crt_farm_task, state, 0);
AT(crt_farm_task, reserved, 4);
AT(crt_farm_task, seconds, 8);
AT(crt_farm_task, estimated, 16);
AT(crt_farm_task, share, 24);
AT(crt_farm_task, worker, 32);

VALUE(CRT_FARM_REPORT_WRITTEN, 0);
VALUE(CRT_FARM_REPORT_MISSING, 1);
VALUE(CRT_FARM_REPORT_REFUSED, 2);

VALUE(CRT_FARM_TASK_WAITING, 0);
VALUE(CRT_FARM_TASK_RUNNING, 1);
VALUE(CRT_FARM_TASK_LOST, 2);
VALUE(CRT_FARM_TASK_DONE, 3);
