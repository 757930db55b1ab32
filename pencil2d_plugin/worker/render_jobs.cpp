#include "worker/render_jobs.h"

#include <algorithm>
#include <limits>

namespace lampblack
{

namespace
{

constexpr int MaxWorkers = 3;

int clamped(quint64 count)
{
    return static_cast<int>(qMin(count, quint64(std::numeric_limits<int>::max() / 2)));
}

QString nameOf(protocol::Outcome outcome)
{
    switch (outcome)
    {
    case protocol::Outcome::Finished:
        return QStringLiteral("finished");
    case protocol::Outcome::Cancelled:
        return QStringLiteral("cancelled");
    case protocol::Outcome::Failed:
        break;
    }
    return QStringLiteral("failed");
}

} // namespace

quint64 RenderJobs::add(const RenderJob& job)
{
    mJobs.insert(++mLast, job);
    return mLast;
}

void RenderJobs::forgetRequests()
{
    const QList<quint64> numbers = mJobs.keys();
    for (const quint64 number : numbers)
    {
        RenderJob& job = mJobs[number];
        job.request = 0;
        job.doneBefore = job.done;
        if (job.asked >= MaxWorkers)
        {
            end(number, protocol::Outcome::Failed);
        }
    }
}

void RenderJobs::end(quint64 job, protocol::Outcome outcome)
{
    if (mJobs.contains(job))
    {
        const RenderJob last = mJobs.take(job);
        Q_EMIT ended(job, nameOf(outcome), last.done, last.total, last.failed);
    }
}

void RenderJobs::endAll(protocol::Outcome outcome)
{
    const QList<quint64> numbers = mJobs.keys();
    for (const quint64 number : numbers)
    {
        end(number, outcome);
    }
}

bool RenderJobs::handle(const protocol::Progress& message)
{
    const auto job = find(message.request);
    if (job == mJobs.end())
    {
        return false;
    }
    job->done = job->doneBefore + clamped(message.framesDone);
    job->total = job->doneBefore + clamped(message.framesTotal);
    Q_EMIT progress(job.key(), message.frame, message.share, job->done, job->total);
    return true;
}

bool RenderJobs::handle(const protocol::FrameDone& message)
{
    const auto job = find(message.request);
    if (job == mJobs.end())
    {
        return false;
    }
    job->frames.removeOne(message.frame);
    ++job->done;
    Q_EMIT frameDone(job.key(), message.frame, message.path);
    return true;
}

bool RenderJobs::handle(const protocol::Done& message)
{
    const auto job = find(message.request);
    if (job == mJobs.end())
    {
        return false;
    }
    job->done = job->doneBefore + clamped(message.framesDone);
    job->total = job->doneBefore + clamped(message.framesTotal);
    job->failed = clamped(message.framesFailed);
    end(job.key(), message.outcome);
    return true;
}

bool RenderJobs::endRequest(quint64 request, protocol::Outcome outcome)
{
    const auto job = find(request);
    if (job == mJobs.end())
    {
        return false;
    }
    end(job.key(), outcome);
    return true;
}

QMap<quint64, RenderJob>::iterator RenderJobs::find(quint64 request)
{
    return std::find_if(mJobs.begin(), mJobs.end(),
                        [request](const RenderJob& job) { return job.request == request; });
}

} // namespace lampblack
