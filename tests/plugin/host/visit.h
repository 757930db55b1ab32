// Tests that run inside Pencil2D, once the project it was started with is open.
#pragma once

#include "host/host.h"

#include <QApplication>
#include <QTest>
#include <QTimer>

#include <cstdlib>

/// Run the test object `Visitor(Host*)` and leave with its result.
template <class Visitor> QObject* visitWhenOpen()
{
    auto* timer = new QTimer(qApp);
    QObject::connect(
        timer, &QTimer::timeout, timer,
        [timer]
        {
            // A project is still being opened: its progress dialog is shown.
            if (QApplication::activeModalWidget() != nullptr)
                return;
            lampblack::Host* host = lampblack::createHost(timer);
            if (host == nullptr || host->projectPath().isEmpty())
            {
                delete host;
                return;
            }
            timer->stop();
            Visitor visitor(host);
            // Without the end of Pencil2D, which is not tested here.
            std::_Exit(QTest::qExec(
                &visitor, {QStringLiteral("visitor"), QStringLiteral("-maxwarnings"), QStringLiteral("0")}));
        });
    constexpr int PollMs = 100;
    timer->start(PollMs);
    return timer;
}
