// Flamenco does the tasks of a job in a folder that all machines see, and then merges them. Put
// this file into the folder `scripts` of the Flamenco Manager. Then make a job,
//
//   crt farm plan scene.crt --frames 1-240 --tasks 64 -o /shared/job
//
// and submit it with its folder and its number of tasks. Not tried on a Flamenco.
const JOB_TYPE = {
  label: "CRT farm",
  settings: [
    { key: "job", type: "string", subtype: "dir_path", required: true,
      description: "The folder that crt farm plan has made" },
    { key: "tasks", type: "int32", required: true,
      description: "How many tasks the job has" },
    { key: "threads", type: "int32", default: 1, description: "Threads of each task" },
    { key: "crt", type: "string", default: "/usr/bin/crt",
      description: "The command on the workers" },
  ],
};

function farmTask(name, settings, args) {
  const task = author.Task(name, "misc");
  task.addCommand(author.Command("exec", { exe: settings.crt, args: ["farm"].concat(args) }));
  return task;
}

function compileJob(job) {
  const settings = job.settings;
  const merge = farmTask("merge", settings, ["merge", settings.job]);
  for (let number = 0; number < settings.tasks; number++) {
    const args = ["work", settings.job, "--task", String(number)];
    const task = farmTask("task-" + number, settings,
      args.concat(["--threads", String(settings.threads), "--quiet"]));
    job.addTask(task);
    merge.addDependency(task);
  }
  job.addTask(merge);
}
