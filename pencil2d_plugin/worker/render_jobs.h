// Render jobs as the user knows them, whichever worker works on them.
#pragma once

#include "protocol/messages.h"
#include "scene/scene.h"

#include <QMap>
#include <QObject>
#include <QVector>

#include <optional>

namespace lampblack
{

struct RenderJob
{
    QVector<int> frames; ///< still to be made
    QString output;
    Quality quality = Quality::Final;
    bool keepFinished = false;
    std::optional<Scene> scene; ///< as it was when the job was asked for
    quint64 lastPut = 0;        ///< drawings put up to here belong to it, see FrameBook
    quint64 request = 0;        ///< 0 while it is not asked of a worker
    int asked = 0;              ///< how often it was
    int done = 0;
    int doneBefore = 0; ///< by workers that died
    int total = 0;
    int failed = 0;
};

/// The jobs that have not ended. A worker's death leaves them here, with the frames that are left to do.
class RenderJobs : public QObject
{
    Q_OBJECT

public:
    using QObject::QObject;

    /// Returns the job's number.
    quint64 add(const RenderJob& job);
    QMap<quint64, RenderJob>& jobs() { return mJobs; }

    /// The worker is gone, and with it the requests; a job that has seen three workers go ends as failed.
    void forgetRequests();
    void end(quint64 job, protocol::Outcome outcome);
    void endAll(protocol::Outcome outcome);

    // False if no job has that request.
    bool take(const protocol::Progress& progress);
    bool take(const protocol::FrameDone& frame);
    bool take(const protocol::Done& done);
    bool endRequest(quint64 request, protocol::Outcome outcome);

Q_SIGNALS:
    void progress(quint64 job, int frame, double share, int done, int total);
    void frameDone(quint64 job, int frame, const QString& path);
    void ended(quint64 job, const QString& outcome, int done, int total, int failed);

private:
    QMap<quint64, RenderJob>::iterator find(quint64 request);

    QMap<quint64, RenderJob> mJobs; ///< by number
    quint64 mLast = 0;
};

} // namespace lampblack
