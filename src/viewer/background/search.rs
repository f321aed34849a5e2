//! The answer to the last question, found on another thread, and one to a question near it meanwhile.
use super::background_task::BackgroundTask;

/// The subject of a search.
pub trait Question: Clone {
    /// Whether both have the same answer.
    fn is_same(&self, other: &Self) -> bool;

    /// Whether the answer of one may stand in for that of the other while that is found.
    fn is_near(&self, other: &Self) -> bool;
}

/// Whether a search that is under way ends before one for a question near it begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Patience {
    /// It is cancelled.
    Cancels,
    /// It ends first. Otherwise none would end while questions keep coming.
    Waits,
}

/// A background search, its last question and its last answer.
pub struct Search<Q, T> {
    found: Option<(Q, T)>,
    asked: Option<Q>,
    pending: Option<BackgroundTask<Option<T>>>,
    /// The search for the last question panicked.
    pub failed: bool,
}

impl<Q, T> Default for Search<Q, T> {
    fn default() -> Search<Q, T> {
        Search { found: None, asked: None, pending: None, failed: false }
    }
}

impl<Q: Question, T: Send + 'static> Search<Q, T> {
    /// Receives an answer, and searches for that of a new question. An answer to a question that is not near is dropped.
    pub fn ask<F>(&mut self, ctx: &egui::Context, question: &Q, patience: Patience, find: impl FnOnce(Q) -> F)
    where
        F: FnOnce(&(dyn Fn() -> bool + Sync)) -> Option<T> + Send + 'static,
    {
        if let (Some(result), Some(asked)) = (BackgroundTask::take(&mut self.pending), &self.asked) {
            self.failed = result.is_err();
            self.found = result.ok().flatten().map(|found| (asked.clone(), found));
        }
        self.found = self.found.take().filter(|(found, _)| found.is_near(question));
        let waits = |asked: &Q| patience == Patience::Waits && self.pending.is_some() && asked.is_near(question);
        if self.asked.as_ref().is_none_or(|asked| !asked.is_same(question) && !waits(asked)) {
            (self.asked, self.failed) = (Some(question.clone()), false);
            self.pending = Some(BackgroundTask::start(ctx, find(question.clone())));
        }
    }

    /// The last answer, and its question.
    pub fn found(&self) -> Option<(&Q, &T)> {
        self.found.as_ref().map(|(question, found)| (question, found))
    }

    /// The answer to this question.
    pub fn answer(&self, question: &Q) -> Option<&T> {
        self.found().filter(|(found, _)| found.is_same(question)).map(|(_, answer)| answer)
    }

    /// The question of the search that is under way.
    pub fn pending(&self) -> Option<&Q> {
        self.asked.as_ref().filter(|_| self.pending.is_some())
    }
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;

    impl Question for u32 {
        fn is_same(&self, other: &u32) -> bool {
            self == other
        }

        fn is_near(&self, other: &u32) -> bool {
            self / 10 == other / 10
        }
    }

    /// Asks until the question is answered.
    fn ask(search: &mut Search<u32, u32>, question: u32, patience: Patience) -> u32 {
        let start = Instant::now();
        loop {
            search.ask(&egui::Context::default(), &question, patience, |question| move |_| Some(2 * question));
            if let Some(answer) = search.answer(&question) {
                return *answer;
            }
            assert!(start.elapsed() < Duration::from_secs(30));
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn an_answer_stays_for_questions_near_it_until_theirs_is_found() {
        for patience in [Patience::Cancels, Patience::Waits] {
            let mut search = Search::default();
            assert_eq!(ask(&mut search, 3, patience), 6);
            search.ask(&egui::Context::default(), &4, patience, |_| |_| None);
            assert_eq!((search.found(), search.answer(&4)), (Some((&3, &6)), None));
            search.ask(&egui::Context::default(), &14, patience, |_| |_| None);
            assert_eq!(search.found(), None);
        }
    }

    #[test]
    fn a_patient_question_waits_for_one_near_it_and_the_other_cancels_it() {
        let never = |_| {
            |cancelled: &(dyn Fn() -> bool + Sync)| {
                while !cancelled() {
                    std::thread::yield_now();
                }
                None
            }
        };
        let (ctx, mut search) = (egui::Context::default(), Search::<u32, u32>::default());
        search.ask(&ctx, &1, Patience::Waits, never);
        search.ask(&ctx, &2, Patience::Waits, never);
        assert_eq!(search.pending(), Some(&1));
        search.ask(&ctx, &12, Patience::Waits, never);
        assert_eq!(search.pending(), Some(&12), "it is not near");
        search.ask(&ctx, &13, Patience::Cancels, never);
        assert_eq!(search.pending(), Some(&13));
    }
}
