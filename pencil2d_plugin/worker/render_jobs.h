// Render jobs as the user sees them. A job may go through several worker processes.
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
    QVector<int> frames; ///< frames that are not rendered yet
    QString output;
    Quality quality = Quality::Final;
    QString project; ///< empty: the drawings that were put
    protocol::ApartKind apart = protocol::ApartKind::None;
    std::optional<Scene> scene; ///< the scene at the start of the job
    quint64 lastPut = 0;        ///< the job needs the drawings up to this call of FrameStore::put()
    quint64 request = 0;        ///< 0 while no worker has the job
    int asked = 0;              ///< how many workers had the job
    int done = 0;
    int doneBefore = 0; ///< frames done by workers that died
    int total = 0;
    int failed = 0;
};

/// The jobs that have not ended. After a worker's death they go on with the frames that are left.
class RenderJobs : public QObject
{
    Q_OBJECT

public:
    using QObject::QObject;

    /// Returns the job's number.
    quint64 add(const RenderJob& job);
    QMap<quint64, RenderJob>& jobs() { return mJobs; }

    /// The worker has ended, and with it the requests. A job that had three workers ends as failed.
    void forgetRequests();
    void end(quint64 job, protocol::Outcome outcome);
    void endAll(protocol::Outcome outcome);

    // These return false if no job has that request.
    bool handle(const protocol::Progress& progress);
    bool handle(const protocol::FrameDone& frame);
    bool handle(const protocol::Done& done);
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
