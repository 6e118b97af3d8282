//! What the system says of the server's process.

use crate::support::Client;
use std::time::Duration;

/// Time of the processor that a server has taken; 0 where the system does not say.
pub fn worked(client: &Client) -> Duration {
    /// Hundredths of a second, on every Linux.
    const TICK: Duration = Duration::from_millis(10);
    let path = format!("/proc/{}/stat", client.child.id());
    let stat = std::fs::read_to_string(path).unwrap_or_default();
    // Behind the name, which may hold spaces: the state, then ten numbers, then the user's and the system's time.
    let fields = stat.rsplit_once(") ").map_or("", |(_, fields)| fields);
    let ticks = fields.split(' ').skip(11).take(2);
    TICK * ticks
        .filter_map(|ticks| ticks.parse::<u32>().ok())
        .sum::<u32>()
}

/// Resident memory in kB; 0 where the system does not say.
pub fn resident(client: &Client) -> u64 {
    let status =
        std::fs::read_to_string(format!("/proc/{}/status", client.child.id())).unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS:"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok())
        .unwrap_or(0)
}
